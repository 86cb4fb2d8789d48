// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/seam.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "cutting/checks.h"
#include "cutting/improve.h"
#include "cutting/retry.h"
#include "operators/driver.h"

namespace femscalpel {
namespace {

/// A node by its place in a mesh, and by its number, if there is one.
struct Numbered {
    Index place, number;
};

/// Where the nodes of another mesh are in this one. Most often it is the same.
class Places {
public:
    explicit Places(const Mesh& mesh) : mesh_(mesh) {}

    /// The place, or -1.
    Index of(const Numbered& node) {
        if (node.number < 0) return -1;
        if (node.place < mesh_.node_count() && mesh_.node_ids[node.place] == node.number) return node.place;
        if (!numbers_) numbers_.emplace(mesh_);
        return numbers_->node(node.number).value_or(-1);
    }

private:
    const Mesh& mesh_;
    std::optional<NumberIndex> numbers_;
};

class Seam final : public Recipe {
public:
    Seam(const Mesh& mesh, std::vector<ImprintLine> lines, bool exact) : imprint_(std::move(lines), exact) {
        for (const ImprintLine& line : imprint_.lines()) {
            std::vector<Numbered>& nodes = known_.emplace_back();
            for (const Index n : line.known) nodes.push_back({n, n < 0 ? -1 : mesh.node_ids[n]});
        }
    }

    const char* kind() const override { return "merge"; }

    /// On a mesh that was converted, or whose double nodes are single, nodes have other places.
    void start(const Mesh& mesh) override {
        Places places(mesh);
        for (std::size_t k = 0; k < known_.size(); ++k) {
            std::vector<Index> nodes;
            for (const Numbered& n : known_[k]) nodes.push_back(places.of(n));
            imprint_.know(k, std::move(nodes));
        }
        blades_.clear();
        for (const ImprintLine& line : imprint_.lines())
            blades_.push_back({line.ribbon, [r = line.ribbon](const Vec3& x) { return r->beyond(x); }, {}});
    }

    std::vector<RefineZone> zones() const override { return {}; }
    std::span<const Blade> blades() const override { return blades_; }

    Naming naming() const override { return {}; }

    bool cut(Workpiece& f, const Site& site) override {
        imprint_.keep_edges(f);
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
        nodes_.clear();
        for (std::size_t k = 0; k < imprinted_.size(); ++k) {
            const ImprintedLine& line = imprinted_[k];
            SeamLine& seam = lines_.emplace_back();
            seam.bound = bound_[k];
            std::vector<Numbered>& nodes = nodes_.emplace_back();
            for (const int v : line.nodes) nodes.push_back({rebuilt.node[v], rebuilt.mesh.node_ids[rebuilt.node[v]]});
            for (const int v : line.at_stop)
                seam.at_stop.push_back(static_cast<std::size_t>(std::ranges::find(line.nodes, v) - line.nodes.begin()));
        }
    }

    /// The lines in what became of the mesh, which may have other places for nodes than what was cut.
    std::vector<SeamLine> lines(const Mesh& result) {
        Places places(result);
        for (std::size_t k = 0; k < lines_.size(); ++k)
            for (const Numbered& n : nodes_[k]) lines_[k].nodes.push_back(places.of(n));
        return std::move(lines_);
    }

private:
    Imprint imprint_;
    std::vector<std::vector<Numbered>> known_;  // by line
    std::vector<Blade> blades_;
    std::vector<ImprintedLine> imprinted_;
    std::vector<std::vector<char>> bound_;      // of their nodes
    std::vector<SeamLine> lines_;               // without their nodes
    std::vector<std::vector<Numbered>> nodes_;  // theirs
};

}  // namespace

Seamed imprint_seam(const Mesh& mesh, std::vector<ImprintLine> lines, bool exact, const OperatorOptions& options,
                    const Prepared& known) {
    Seam recipe(mesh, std::move(lines), exact);
    Seamed out{perform(recipe, mesh, options, known), {}};
    out.lines = recipe.lines(out.result.mesh);
    return out;
}

}  // namespace femscalpel
