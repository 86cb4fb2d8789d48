// SPDX-License-Identifier: LGPL-2.1-or-later
#include <algorithm>
#include <map>
#include <numeric>
#include <optional>
#include <vector>

#include "cancel.h"
#include "io/med_fields.h"

namespace femscalpel {
namespace {

class MedFieldWriter {
public:
    MedFieldWriter(const Mesh& mesh, const MedFieldTarget& target)
        : mesh_(mesh), target_(target), fields_(*mesh.fields), numbers_(mesh) {}

    void write() {
        for (const FieldLocalization& localization : fields_.localizations) write_localization(localization);
        for (const Field& field : fields_.fields) {
            check_cancelled();
            write_field(field);
        }
    }

private:
    void check(med_err result, const std::string& what) const {
        if (result < 0) target_.fail(what);
    }

    /// Of a text that a place of so many bytes has to hold.
    const std::string& fitting(const std::string& text, std::size_t size, const std::string& what) const {
        if (text.size() > size)
            target_.fail(what + " '" + text + "': it has " + std::to_string(text.size()) + " bytes, MED allows " +
                         std::to_string(size));
        return text;
    }

    std::string in_columns(const std::vector<std::string>& texts, const std::string& what) const {
        std::string out;
        for (const std::string& text : texts) {
            out += fitting(text, MED_SNAME_SIZE, what);
            out.resize((out.size() + MED_SNAME_SIZE - 1) / MED_SNAME_SIZE * MED_SNAME_SIZE, ' ');
            if (text.empty()) out.append(MED_SNAME_SIZE, ' ');
        }
        return out;
    }

    void write_localization(const FieldLocalization& l) const {
        const MedType& type = med_type(l.type);
        const auto d = static_cast<std::size_t>(l.dimension);
        std::vector<double> element(l.element.size());
        for (std::size_t k = 0; k < element.size() / d; ++k)
            for (std::size_t a = 0; a < d; ++a)
                element[static_cast<std::size_t>(type.order[k]) * d + a] = l.element[k * d + a];
        check(MEDlocalizationWr(target_.fid, fitting(l.name, MED_NAME_SIZE, "the localization").c_str(), type.geometry,
                                l.dimension, element.data(), MED_FULL_INTERLACE, static_cast<med_int>(l.weights.size()),
                                l.points.data(), l.weights.data(), MED_NO_INTERPOLATION, MED_NO_MESH_SUPPORT),
              "the localization '" + l.name + "'");
    }

    void write_field(const Field& field) {
        const std::string what = "field '" + field.name + "'";
        constexpr med_field_type types[] = {MED_FLOAT64, MED_FLOAT32, MED_INT32, MED_INT64};
        const std::string components = in_columns(field.components, "the component of " + what),
                          units = in_columns(field.units, "the unit of " + what);
        check(MEDfieldCr(target_.fid, fitting(field.name, MED_NAME_SIZE, "the name of the field").c_str(),
                         types[static_cast<int>(field.values)], static_cast<med_int>(field.components.size()),
                         components.c_str(), units.c_str(),
                         fitting(field.time_unit, MED_SNAME_SIZE, "the time unit of " + what).c_str(), target_.mesh),
              what);
        for (const FieldStep& step : field.steps)
            for (const FieldPart& part : step.parts) {
                check_cancelled();
                write_part(field, step, part);
            }
    }

    /// Which rows of a part are written, and at which places of the file's nodes or elements of its type, ascending.
    struct Choice {
        std::vector<std::size_t> rows;
        std::vector<med_int> places;  // from 1 on
        bool all = false;
    };

    Choice choose(const FieldPart& part) const {
        Choice out;
        const bool of_nodes = part.support == FieldSupport::node;
        const std::vector<Index>& ids = of_nodes ? mesh_.node_ids : mesh_.block(part.type).ids;
        const Index total = of_nodes ? std::ssize(ids) : target_.count(part.type);
        std::vector<std::pair<med_int, std::size_t>> places;
        for (std::size_t row = 0; row < part.numbers->size(); ++row) {
            const Index number = (*part.numbers)[row];
            std::optional<Index> at;
            if (row < ids.size() && ids[row] == number)
                at = static_cast<Index>(row);
            else if (of_nodes)
                at = numbers_.node(number);
            else if (const auto cell = numbers_.cell(number); cell && cell->type == part.type)
                at = cell->cell;
            if (at) places.emplace_back(static_cast<med_int>(*at + 1), row);
        }
        std::ranges::sort(places);
        for (const auto& [place, row] : places) {
            out.places.push_back(place);
            out.rows.push_back(row);
        }
        out.all = std::ssize(places) == total;
        return out;
    }

    /// The name of a profile of these places, written if it is new.
    std::string profile_of(const FieldPart& part, const Choice& choice) {
        if (choice.all) return MED_NO_PROFILE;
        const std::string wanted = part.profile.empty() ? "PROFILE" : part.profile;
        for (int k = 1;; ++k) {
            const std::string tail = k == 1 ? "" : "_" + std::to_string(k);
            std::string name = wanted.substr(0, MED_NAME_SIZE - tail.size()) + tail;
            const auto [it, added] = profiles_.try_emplace(name, choice.places);
            if (!added && it->second != choice.places) continue;
            if (added)
                check(MEDprofileWr(target_.fid, name.c_str(), static_cast<med_int>(choice.places.size()),
                                   choice.places.data()),
                      "the profile '" + name + "'");
            return name;
        }
    }

    template <class Stored>
    std::vector<unsigned char> bytes_of(const FieldPart& part, const Choice& choice, std::size_t components,
                                        const auto& values) const {
        const auto points = static_cast<std::size_t>(part.points);
        std::vector<Stored> out;
        out.reserve(choice.rows.size() * points * components);
        const MedType& type = med_type(part.type);
        std::vector<std::size_t> from(points);
        std::iota(from.begin(), from.end(), 0);
        if (part.support == FieldSupport::element_nodes)
            for (std::size_t k = 0; k < points; ++k) from[static_cast<std::size_t>(type.order[k])] = k;
        for (const std::size_t row : choice.rows)
            for (const std::size_t point : from)
                for (std::size_t c = 0; c < components; ++c)
                    out.push_back(static_cast<Stored>(values[(row * points + point) * components + c]));
        const auto* first = reinterpret_cast<const unsigned char*>(out.data());
        return {first, first + out.size() * sizeof(Stored)};
    }

    std::vector<unsigned char> bytes_of(const Field& field, const FieldPart& part, const Choice& choice) const {
        const std::size_t components = field.components.size();
        switch (field.values) {
            case FieldValues::float64:
                return bytes_of<double>(part, choice, components, part.reals);
            case FieldValues::float32:
                return bytes_of<float>(part, choice, components, part.reals);
            case FieldValues::int32:
                return bytes_of<std::int32_t>(part, choice, components, part.integers);
            default:
                return bytes_of<std::int64_t>(part, choice, components, part.integers);
        }
    }

    void write_part(const Field& field, const FieldStep& step, const FieldPart& part) {
        const Choice choice = choose(part);
        if (choice.rows.empty()) return;
        const std::string profile = profile_of(part, choice);
        med_entity_type entity = MED_CELL;
        if (part.support == FieldSupport::node) entity = MED_NODE;
        if (part.support == FieldSupport::element_nodes && part.localization != MED_GAUSS_ELNO)
            entity = MED_NODE_ELEMENT;
        const std::string& localization = part.localization;
        const std::vector<unsigned char> bytes = bytes_of(field, part, choice);
        check(MEDfieldValueWithProfileWr(target_.fid, field.name.c_str(), static_cast<med_int>(step.number),
                                         static_cast<med_int>(step.iteration), step.time, entity,
                                         entity == MED_NODE ? MED_NONE : med_type(part.type).geometry,
                                         MED_COMPACT_STMODE, profile.c_str(), localization.c_str(), MED_FULL_INTERLACE,
                                         MED_ALL_CONSTITUENT, static_cast<med_int>(choice.rows.size()), bytes.data()),
              "field '" + field.name + "'");
    }

    const Mesh& mesh_;
    const MedFieldTarget& target_;
    const Fields& fields_;
    const NumberIndex numbers_;
    std::map<std::string, std::vector<med_int>> profiles_;
};

}  // namespace

void write_med_fields(const Mesh& mesh, const MedFieldTarget& target) {
    if (mesh.fields) MedFieldWriter(mesh, target).write();
}

}  // namespace femscalpel
