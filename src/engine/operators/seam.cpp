// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/seam.h"

#include <algorithm>

#include "cutting/checks.h"
#include "cutting/improve.h"
#include "cutting/retry.h"
#include "operators/driver.h"

namespace femscalpel {
namespace {

class Seam final : public Recipe {
public:
    Seam(std::vector<ImprintLine> lines, bool exact) : imprint_(std::move(lines), exact) {}

    const char* kind() const override { return "merge"; }

    void start(const Mesh&) override {
        blades_.clear();
        for (const ImprintLine& line : imprint_.lines())
            blades_.push_back({line.ribbon, [r = line.ribbon](const Vec3& x) { return r->beyond(x); }, {}});
    }

    std::vector<RefineZone> zones() const override { return {}; }
    std::span<const Blade> blades() const override { return blades_; }

    Naming naming() const override { return {}; }

    bool cut(Workpiece& f, const Site& site) override {
        cut_soundly(
            f,
            [&](Workpiece& g) {
                imprint_.run(g);
                relax_band(g);
            },
            site.whole.cell_count());
        return true;
    }

    Opening open(Workpiece& f, const Site& site) override {
        check_shape(f, site.mesh);
        Opening out = no_opening(f.d.band);
        imprinted_ = imprint_.result(f);
        bound_.clear();
        for (const ImprintedLine& line : imprinted_) {
            std::vector<char>& bound = bound_.emplace_back();
            for (const int v : line.nodes) bound.push_back(f.is_bound(v) ? 1 : 0);
        }
        for (const ImprintedLine& line : imprinted_)
            out.interface_nodes.insert(out.interface_nodes.end(), line.nodes.begin(), line.nodes.end());
        std::ranges::sort(out.interface_nodes);
        const auto [rest, end] = std::ranges::unique(out.interface_nodes);
        out.interface_nodes.erase(rest, end);
        find_node_sets(f);
        return out;
    }

    void finished(const Rebuilt& rebuilt) override {
        lines_.clear();
        for (std::size_t k = 0; k < imprinted_.size(); ++k) {
            const ImprintedLine& line = imprinted_[k];
            SeamLine& seam = lines_.emplace_back();
            seam.bound = bound_[k];
            for (const int v : line.nodes) seam.nodes.push_back(rebuilt.node[v]);
            for (const int v : line.at_stop)
                seam.at_stop.push_back(static_cast<std::size_t>(std::ranges::find(line.nodes, v) - line.nodes.begin()));
        }
    }

    std::vector<SeamLine>& lines() { return lines_; }

private:
    Imprint imprint_;
    std::vector<Blade> blades_;
    std::vector<ImprintedLine> imprinted_;
    std::vector<std::vector<char>> bound_;  // of their nodes
    std::vector<SeamLine> lines_;
};

}  // namespace

Seamed imprint_seam(const Mesh& mesh, std::vector<ImprintLine> lines, bool exact, const OperatorOptions& options,
                    const Prepared& known) {
    Seam recipe(std::move(lines), exact);
    Result result = perform(recipe, mesh, options, known);
    return {std::move(result), std::move(recipe.lines())};
}

}  // namespace femscalpel
