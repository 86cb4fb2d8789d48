// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fields/carry.h"

#include <algorithm>
#include <array>
#include <map>

#include "cancel.h"
#include "fields/element_values.h"
#include "fields/lineage.h"
#include "fields/reference_element.h"

namespace femscalpel {
namespace {

/// Shares of a part's rows in a value.
using Shares = std::vector<std::pair<Index, double>>;

/// Row of a part for each node of a mesh, or element of the part's type; -1 where there is none.
std::vector<Index> rows_of(const FieldPart& part, const std::vector<Index>& ids, const NumberIndex& numbers) {
    std::vector<Index> rows(ids.size(), -1);
    for (std::size_t row = 0; row < part.numbers->size(); ++row) {
        const Index number = (*part.numbers)[row];
        std::optional<Index> at;
        if (row < ids.size() && ids[row] == number)
            at = static_cast<Index>(row);
        else if (part.support == FieldSupport::node)
            at = numbers.node(number);
        else if (const auto cell = numbers.cell(number); cell && cell->type == part.type)
            at = cell->cell;
        if (at) rows[static_cast<std::size_t>(*at)] = static_cast<Index>(row);
    }
    return rows;
}

/// A part being filled; `blocks` values per component and entity.
class Filling {
public:
    Filling(const Field& field, const FieldPart& from, CellType type, int points, std::string localization)
        : whole_(field.whole()), components_(field.components.size()) {
        part_.support = from.support;
        part_.type = type;
        part_.points = points;
        part_.localization = std::move(localization);
        part_.profile = from.profile;
    }

    void add_number(Index number) { numbers_.push_back(number); }

    /// Appends one row as it is.
    void copy(const FieldPart& from, Index row) { take(from, row * from.points, from.points); }

    /// Appends the value of one point: `shares` of points of `from`, counted through all its rows. Of whole numbers
    /// that of the largest share.
    void mix(const FieldPart& from, const Shares& shares) {
        if (whole_ || shares.size() == 1) {
            const auto largest = std::ranges::max_element(shares, {}, [](const auto& s) { return s.second; });
            take(from, largest->first, 1);
            return;
        }
        for (std::size_t c = 0; c < components_; ++c) {
            double sum = 0;
            for (const auto& [point, share] : shares)
                sum += share * from.reals[static_cast<std::size_t>(point) * components_ + c];
            part_.reals.push_back(sum);
        }
    }

    bool empty() const { return numbers_.empty(); }
    const FieldPart& part() const { return part_; }

    FieldPart finish() {
        part_.numbers = std::make_shared<const std::vector<Index>>(std::move(numbers_));
        return std::move(part_);
    }

private:
    void take(const FieldPart& from, Index first, Index count) {
        const auto begin = first * static_cast<Index>(components_),
                   end = begin + count * static_cast<Index>(components_);
        if (whole_)
            part_.integers.insert(part_.integers.end(), from.integers.begin() + begin, from.integers.begin() + end);
        else
            part_.reals.insert(part_.reals.end(), from.reals.begin() + begin, from.reals.begin() + end);
    }

    bool whole_;
    std::size_t components_;
    FieldPart part_;
    std::vector<Index> numbers_;
};

/// A part being filled with elements, which come from rows of parts of the input.
struct Growing {
    struct Entry {
        Index cell;  // in the result
        const FieldPart* from;
        Index row;
    };
    Filling filling;
    std::vector<Entry> entries;
};

class Carrier {
public:
    explicit Carrier(const FieldCarrying& c)
        : lineage_(c.before, c.after, c.stages, c.added),
          before_(c.before),
          after_(c.after),
          numbers_(c.before),
          after_numbers_(c.after),
          fields_(*c.before.fields) {}

    std::shared_ptr<const Fields> run(std::vector<FieldRecord>& records) {
        auto out = std::make_shared<Fields>();
        made_ = out.get();
        out->localizations = fields_.localizations;
        for (const Field& field : fields_.fields) {
            Field& now = out->fields.emplace_back(field);
            now.steps.clear();
            std::map<FieldSupport, FieldRecord> of_field;
            for (const FieldStep& step : field.steps) {
                check_cancelled();
                now.steps.push_back({step.number, step.iteration, step.time, {}});
                carry_step(field, step, now.steps.back(), of_field);
            }
            for (auto& [support, record] : of_field) {
                record.name = field.name;
                record.support = support;
                records.push_back(std::move(record));
            }
        }
        return out;
    }

private:
    void carry_step(const Field& field, const FieldStep& step, FieldStep& out,
                    std::map<FieldSupport, FieldRecord>& records) {
        for (const FieldSupport support :
             {FieldSupport::node, FieldSupport::element, FieldSupport::element_nodes, FieldSupport::element_points}) {
            std::vector<const FieldPart*> parts;
            for (const FieldPart& part : step.parts)
                if (part.support == support) parts.push_back(&part);
            if (parts.empty()) continue;
            FieldRecord& record = records[support];
            ++record.steps;
            if (support == FieldSupport::node)
                for (const FieldPart* part : parts) carry_nodes(field, *part, out, record);
            else
                carry_elements(field, parts, out, record);
            count_removed(parts, record);
        }
    }

    void count_removed(const std::vector<const FieldPart*>& parts, FieldRecord& record) const {
        for (const FieldPart* part : parts)
            for (const Index number : *part->numbers)
                record.removed +=
                    part->support == FieldSupport::node ? !after_numbers_.node(number) : !after_numbers_.cell(number);
    }

    static void count_outside(double off, FieldRecord& record) {
        if (off == 0) return;
        ++record.outside;
        record.farthest = std::max(record.farthest, off);
    }

    void carry_nodes(const Field& field, const FieldPart& part, FieldStep& out, FieldRecord& record) {
        const std::vector<Index> rows = rows_of(part, before_.node_ids, numbers_);
        Filling filling(field, part, part.type, 1, {});
        const auto in_rows = [&](const Shares& shares) {
            Shares found;
            for (const auto& [node, share] : shares) {
                if (rows[static_cast<std::size_t>(node)] < 0) return Shares();
                found.emplace_back(rows[static_cast<std::size_t>(node)], share);
            }
            return found;
        };
        auto made = lineage_.made_nodes().begin();
        SparseCheck check(1 << 14);
        for (Index n = 0; n < after_.node_count(); ++n, check()) {
            const Index was = lineage_.nodes()[n], number = after_.node_ids[n];
            if (was >= 0) {
                const Index row = rows[static_cast<std::size_t>(was)];
                if (row < 0) continue;
                filling.add_number(number);
                filling.copy(part, row);
                ++(lineage_.is_copy(n) ? record.doubled : record.kept);
                continue;
            }
            if (was == FieldLineage::unknown) {
                ++record.absent;
                continue;
            }
            const FieldLineage::Made& here = *made++;
            Shares shares = in_rows(here.shares);
            // Fields on the corners alone are linear.
            if (shares.empty()) shares = in_rows(here.corner_shares);
            if (shares.empty()) {
                const auto had = numbers_.node(number);
                record.absent += had && rows[static_cast<std::size_t>(*had)] >= 0;
                continue;
            }
            filling.add_number(number);
            filling.mix(part, shares);
            ++(here.doubled ? record.doubled : record.made);
            count_outside(here.outside, record);
        }
        out.parts.push_back(filling.finish());
    }

    void carry_elements(const Field& field, const std::vector<const FieldPart*>& parts, FieldStep& out,
                        FieldRecord& record) {
        std::vector<Growing> growing;
        growing.reserve(parts.size());
        sources_.clear();
        for (const FieldPart* part : parts)
            growing.push_back({Filling(field, *part, part->type, part->points, part->localization), {}});
        std::array<bool, 4> dimensions{};
        for (std::size_t p = 0; p < parts.size(); ++p) {
            const FieldPart& part = *parts[p];
            dimensions[static_cast<std::size_t>(traits(part.type).dimension)] = true;
            sources_.push_back({&part, rows_of(part, before_.block(part.type).ids, numbers_)});
            const std::vector<Index>& rows = sources_.back().rows;
            for (const CellBlock& b : after_.blocks()) {
                if (b.size() == 0 || traits(b.type).dimension != traits(part.type).dimension) continue;
                const auto& parents = lineage_.parents(b.type);
                Growing* to = nullptr;
                SparseCheck check(1 << 14);
                for (Index c = 0; c < b.size(); ++c, check()) {
                    const FieldLineage::Parent& parent = parents[static_cast<std::size_t>(c)];
                    if (parent.cell < 0 || parent.type != part.type) continue;
                    const Index row = rows[static_cast<std::size_t>(parent.cell)];
                    if (row < 0) continue;
                    if (!to) to = &growing[b.type == part.type ? p : part_for(field, parts, part, b.type, growing)];
                    to->entries.push_back({c, &part, row});
                }
            }
        }
        for (Growing& g : growing) fill(g, out, record);
        for (const CellBlock& b : after_.blocks())
            if (dimensions[static_cast<std::size_t>(traits(b.type).dimension)])
                for (const FieldLineage::Parent& parent : lineage_.parents(b.type)) record.absent += parent.cell < 0;
    }

    /// Which of `growing` takes elements of a type that those of `part` became.
    std::size_t part_for(const Field& field, const std::vector<const FieldPart*>& parts, const FieldPart& part,
                         CellType type, std::vector<Growing>& growing) {
        int points = part.support == FieldSupport::element_nodes ? traits(type).nodes : 1;
        std::string localization;
        if (part.support == FieldSupport::element_points) {
            const auto known = std::ranges::find_if(
                parts, [&](const FieldPart* p) { return p->type == type && reference(p->localization); });
            if (known != parts.end()) {
                points = (*known)->points;
                localization = (*known)->localization;
            } else {
                localization = middle(type);
            }
        }
        for (std::size_t g = 0; g < growing.size(); ++g) {
            const FieldPart& there = growing[g].filling.part();
            if (there.type == type && there.points == points && there.localization == localization) return g;
        }
        growing.push_back({Filling(field, part, type, points, localization), {}});
        return growing.size() - 1;
    }

    std::string middle(CellType type) {
        FieldLocalization out = middle_point(type);
        if (!made_->localization(out.name)) made_->localizations.push_back(out);
        return out.name;
    }

    /// Points of a localization in the coordinates of the reference element; null if they are not known.
    const Eigen::MatrixXd* reference(const std::string& name) {
        const auto [it, added] = references_.try_emplace(name);
        if (added)
            if (const FieldLocalization* localization = made_->localization(name))
                it->second = reference_points(*localization);
        return it->second ? &*it->second : nullptr;
    }

    void fill(Growing& g, FieldStep& out, FieldRecord& record) {
        std::ranges::sort(g.entries, {}, &Growing::Entry::cell);
        const CellBlock& block = after_.block(g.filling.part().type);
        SparseCheck check(1 << 10);
        for (const Growing::Entry& e : g.entries) {
            check();
            const FieldLineage::Parent& parent = lineage_.parents(block.type)[static_cast<std::size_t>(e.cell)];
            g.filling.add_number(block.ids[static_cast<std::size_t>(e.cell)]);
            ++(parent.same ? record.kept : record.parts);
            if (parent.same || e.from->support == FieldSupport::element)
                g.filling.copy(*e.from, e.row);
            else if (e.from->support == FieldSupport::element_nodes)
                at_nodes(g.filling, {block.type, e.cell}, {parent.type, parent.cell}, e, record);
            else
                at_points(g.filling, {block.type, e.cell}, {parent.type, parent.cell}, e);
        }
        if (!g.filling.empty()) out.parts.push_back(g.filling.finish());
    }

    /// Of the elements of the input a part has values of.
    struct Source {
        const FieldPart* part;
        std::vector<Index> rows;
    };

    /// Where a point of an element has its values from: an element of the input, and shares of what that has.
    struct PointSource {
        CellRef cell;
        std::vector<double> shares;
        double off = 0;  ///< InElement::outside
        std::string localization;
    };
    /// The same for every step and field on elements' nodes, or points of one localization.
    using KnownSources = std::map<std::pair<CellType, Index>, std::vector<PointSource>>;

    /// Appends the values of a point, from the element that it lies in or, if that has none, the one that it is a part
    /// of. `find` gives the shares in either.
    template <class Find>
    void add_point(Filling& filling, PointSource& known, const Vec3& at, const Vec3& middle, CellRef was,
                   const Growing::Entry& e, FieldRecord* record, Find find) {
        const auto row_in = [&](CellRef cell) -> std::pair<const FieldPart*, Index> {
            for (const Source& s : sources_)
                if (s.part->type == cell.type)
                    if (const Index row = s.rows[static_cast<std::size_t>(cell.cell)]; row >= 0) return {s.part, row};
            return {e.from, e.row};
        };
        if (known.shares.empty()) known.cell = lineage_.element_at(was, at, middle);
        auto [part, row] = row_in(known.cell);
        PointSource other;
        PointSource* source = &known;
        if (known.cell != was && part == e.from && row == e.row) {
            // What it lies in has no values.
            other.cell = was;
            source = &other;
        }
        if (source->shares.empty() || source->localization != part->localization) {
            source->shares.clear();
            source->off = 0;
            find(*source, *part);
            source->localization = part->localization;
        }
        Shares shares;
        for (std::size_t k = 0; k < source->shares.size(); ++k)
            shares.emplace_back(row * part->points + static_cast<Index>(k), source->shares[k]);
        filling.mix(*part, shares);
        if (record) count_outside(source->off, *record);
    }

    Vec3 middle_of(CellRef cell) const {
        const auto nodes = after_.block(cell.type).nodes(cell.cell);
        Vec3 sum = Vec3::Zero();
        for (const Index n : nodes) sum += after_.points[n];
        return sum / static_cast<double>(nodes.size());
    }

    void at_nodes(Filling& filling, CellRef now, CellRef was, const Growing::Entry& e, FieldRecord& record) {
        const Vec3 middle = middle_of(now);
        const auto old_nodes = before_.block(was.type).nodes(was.cell);
        const Index first = e.row * e.from->points;
        const auto nodes = after_.block(now.type).nodes(now.cell);
        std::vector<PointSource>& known = at_nodes_[{now.type, now.cell}];
        known.resize(nodes.size());
        for (std::size_t k = 0; k < nodes.size(); ++k) {
            const Vec3& at = after_.points[nodes[k]];
            const auto in_place = std::ranges::find_if(old_nodes, [&](Index old) { return before_.points[old] == at; });
            if (in_place != old_nodes.end()) {
                filling.mix(*e.from, {{first + (in_place - old_nodes.begin()), 1.}});
                continue;
            }
            add_point(filling, known[k], at, middle, was, e, &record, [&](PointSource& to, const FieldPart& part) {
                if (const auto in = FieldLineage::shares_in(before_, to.cell, at, to.off))
                    to.shares = *in;
                else
                    to.shares.assign(static_cast<std::size_t>(part.points), 1. / part.points);
            });
        }
    }

    /// Of the values at an element's integration points, which serves all its parts.
    const LinearFit& fit_of(CellRef cell, const std::string& localization, const Eigen::MatrixXd& points) {
        auto& known = fits_[localization];
        const auto found = known.find({cell.type, cell.cell});
        if (found != known.end()) return found->second;
        return known.emplace(std::pair(cell.type, cell.cell), places_of(before_, cell, points)).first->second;
    }

    void at_points(Filling& filling, CellRef now, CellRef was, const Growing::Entry& e) {
        const Eigen::MatrixXd* const to = reference(filling.part().localization);
        const Vec3 middle = middle_of(now);
        const auto points = static_cast<std::size_t>(filling.part().points);
        Eigen::Matrix3Xd at = middle.replicate(1, filling.part().points);
        if (to) at = places_of(after_, now, *to);
        std::vector<PointSource>& known = at_points_[filling.part().localization][{now.type, now.cell}];
        known.resize(points);
        for (std::size_t p = 0; p < points; ++p) {
            const Vec3 place = at.col(static_cast<Eigen::Index>(p));
            add_point(filling, known[p], place, middle, was, e, nullptr, [&](PointSource& s, const FieldPart& part) {
                const Eigen::MatrixXd* const from = reference(part.localization);
                if (from && to)
                    s.shares = fit_of(s.cell, part.localization, *from).shares(place);
                else
                    s.shares.assign(static_cast<std::size_t>(part.points), 1. / part.points);
            });
        }
    }

    FieldLineage lineage_;
    const Mesh &before_, &after_;
    NumberIndex numbers_, after_numbers_;
    const Fields& fields_;
    Fields* made_ = nullptr;
    std::map<std::string, std::optional<Eigen::MatrixXd>> references_;
    std::vector<Source> sources_;  // of the support being carried
    KnownSources at_nodes_;
    std::map<std::string, KnownSources> at_points_;                                // by localization
    std::map<std::string, std::map<std::pair<CellType, Index>, LinearFit>> fits_;  // by localization
};

}  // namespace

std::shared_ptr<const Fields> carry_fields(const FieldCarrying& carrying, std::vector<FieldRecord>& records) {
    if (!carrying.before.fields || carrying.before.fields->fields.empty()) return {};
    return Carrier(carrying).run(records);
}

}  // namespace femscalpel
