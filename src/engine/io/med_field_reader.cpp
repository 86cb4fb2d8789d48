// SPDX-License-Identifier: LGPL-2.1-or-later
#include <algorithm>
#include <map>
#include <optional>
#include <vector>

#include "cancel.h"
#include "io/med_fields.h"
#include "io/med_structure.h"
#include "utf8.h"

namespace femscalpel {
namespace {

/// Attributes are no longer than that (med_structure.h), whatever the library thinks.
constexpr std::size_t text_size = longest_med_attribute + 1;
constexpr med_int most_components = 4000;

/// A part of a text of fields of equal width, up to the first NUL, without trailing blanks.
std::string cut_out(const std::string& text, std::size_t field, std::size_t width) {
    std::string out = text.substr(std::min(text.size(), field * width), width);
    out.resize(std::min(out.size(), out.find('\0')));
    while (out.ends_with(' ')) out.pop_back();
    return out;
}

/// Why a field is not read.
struct Unread {
    std::string why;
};

class MedFieldReader {
public:
    MedFieldReader(const MedFieldSource& source, Mesh& mesh) : source_(source), fid_(source.fid), mesh_(mesh) {}

    std::shared_ptr<const Fields> read() {
        const med_int count = source_.sound.of_fields() ? MEDnField(fid_) : -1;
        if (count == 0) return {};
        if (count < 0) {
            mesh_.remarks.push_back(as_utf8(source_.path) + ": the fields are not read: they are damaged");
            return {};
        }
        for (int i = 1; i <= count; ++i) {
            check_cancelled();
            read_field(i);
        }
        make_names_utf8();
        return out_->fields.empty() ? nullptr : out_;
    }

private:
    /// At the end: the file finds things by the names it has.
    void make_names_utf8() {
        const auto all = [](std::vector<std::string>& names) {
            for (std::string& name : names) name = as_utf8(std::move(name));
        };
        for (Field& field : out_->fields) {
            field.name = as_utf8(std::move(field.name));
            field.time_unit = as_utf8(std::move(field.time_unit));
            all(field.components);
            all(field.units);
            for (FieldStep& step : field.steps)
                for (FieldPart& part : step.parts) {
                    part.profile = as_utf8(std::move(part.profile));
                    part.localization = as_utf8(std::move(part.localization));
                }
        }
        for (FieldLocalization& l : out_->localizations) l.name = as_utf8(std::move(l.name));
    }

    void read_field(int i) {
        Field field;
        try {
            if (read_header(i, field)) out_->fields.push_back(std::move(field));
        } catch (const Unread& unread) {
            mesh_.remarks.push_back(as_utf8(source_.path) + ": field '" + as_utf8(field.name) +
                                    "' is not read: " + as_utf8(unread.why));
        }
    }

    /// False if it is on another mesh.
    bool read_header(int i, Field& field) {
        const med_int components = MEDfieldnComponent(fid_, i);
        std::string name(text_size, '\0'), on(text_size, '\0'), names(text_size, '\0'), units(text_size, '\0'),
            time_unit(text_size, '\0');
        med_bool local = MED_TRUE;
        med_field_type type = MED_FLOAT64;
        med_int steps = 0;
        if (MEDfieldInfo(fid_, i, name.data(), on.data(), &local, &type, names.data(), units.data(), time_unit.data(),
                         &steps) < 0)
            throw Unread{"its description is damaged"};
        field.name = name.c_str();
        if (components < 1 || components > most_components)
            throw Unread{"it has " + std::to_string(components) + " components"};
        if (!source_.old && source_.mesh != on.c_str()) return false;
        for (std::size_t k = 0; k < static_cast<std::size_t>(components); ++k) {
            field.components.push_back(cut_out(names, k, MED_SNAME_SIZE));
            field.units.push_back(cut_out(units, k, MED_SNAME_SIZE));
        }
        field.time_unit = cut_out(time_unit, 0, MED_SNAME_SIZE);
        switch (as_number(type)) {
            case MED_FLOAT64:
                field.values = FieldValues::float64;
                break;
            case MED_FLOAT32:
                field.values = FieldValues::float32;
                break;
            case MED_INT32:
                field.values = FieldValues::int32;
                break;
            case MED_INT64:
                field.values = FieldValues::int64;
                break;
            case MED_INT:
                field.values = sizeof(med_int) == 4 ? FieldValues::int32 : FieldValues::int64;
                break;
            default:
                throw Unread{"its values are neither real nor whole numbers"};
        }
        for (int s = 1; s <= steps; ++s) read_step(s, field);
        return !source_.old || steps == 0 || !field.steps.empty();
    }

    void read_step(int s, Field& field) {
        check_cancelled();
        med_int number = MED_NO_DT, iteration = MED_NO_IT;
        med_float time = 0;
        if (source_.old) {
            med_int meshes = 0, mesh_step = 0, mesh_iteration = 0;
            std::string on(text_size, '\0');
            med_bool local = MED_TRUE;
            if (MEDfield23ComputingStepMeshInfo(fid_, field.name.c_str(), s, &number, &iteration, &time, &meshes,
                                                on.data(), &local, &mesh_step, &mesh_iteration) < 0)
                throw Unread{"time step " + std::to_string(s) + " is damaged"};
            if (meshes == 1 && source_.mesh != on.c_str()) return;
        } else if (MEDfieldComputingStepInfo(fid_, field.name.c_str(), s, &number, &iteration, &time) < 0) {
            throw Unread{"time step " + std::to_string(s) + " is damaged"};
        }
        FieldStep step{number, iteration, time, {}};
        read_parts(field, step, MED_NODE, MED_NONE, nullptr);
        for (const CellTraits& t : all_cell_types())
            for (const med_entity_type entity : {MED_CELL, MED_NODE_ELEMENT})
                if (mesh_.block(t.type).size() > 0) read_parts(field, step, entity, med_type(t.type).geometry, &t);
        if (s == 1) tell_others(field, number, iteration);
        if (source_.old && step.parts.empty()) return;
        field.steps.push_back(std::move(step));
    }

    /// Fields on faces and edges of elements, which files of descending connectivity have.
    void tell_others(const Field& field, med_int number, med_int iteration) {
        std::string profile(text_size, '\0'), localization(text_size, '\0');
        if (source_.old) return;
        for (const CellTraits& t : all_cell_types())
            for (const med_entity_type entity : {MED_DESCENDING_FACE, MED_DESCENDING_EDGE})
                if (t.dimension == (entity == MED_DESCENDING_FACE ? 2 : 1) &&
                    MEDfieldnProfile(fid_, field.name.c_str(), number, iteration, entity, med_type(t.type).geometry,
                                     profile.data(), localization.data()) > 0)
                    throw Unread{"it is on faces or edges of elements that are none themselves"};
    }

    /// What the library says of a profile's values.
    struct Chunk {
        std::string profile, localization;
        med_int size = 0;    // of the profile
        med_int points = 1;  // per entity
        med_int count = 0;   // of entities
    };

    void read_parts(const Field& field, FieldStep& step, med_entity_type entity, med_geometry_type geometry,
                    const CellTraits* type) {
        std::string mesh = source_.mesh, profile(text_size, '\0'), localization(text_size, '\0');
        mesh.resize(text_size);
        const auto number = static_cast<med_int>(step.number), iteration = static_cast<med_int>(step.iteration);
        const med_int profiles = source_.old
                                     ? MEDfield23nProfile(fid_, field.name.c_str(), number, iteration, entity, geometry,
                                                          1, mesh.data(), profile.data(), localization.data())
                                     : MEDfieldnProfile(fid_, field.name.c_str(), number, iteration, entity, geometry,
                                                        profile.data(), localization.data());
        if (source_.old && profiles > 0 && source_.mesh != mesh.c_str()) return;
        for (int p = 1; p <= profiles; ++p) {
            Chunk chunk;
            std::string name(text_size, '\0'), at(text_size, '\0');
            chunk.count =
                source_.old
                    ? MEDfield23nValueWithProfile(fid_, field.name.c_str(), number, iteration, entity, geometry,
                                                  source_.mesh.c_str(), p, MED_COMPACT_STMODE, name.data(), &chunk.size,
                                                  at.data(), &chunk.points)
                    : MEDfieldnValueWithProfile(fid_, field.name.c_str(), number, iteration, entity, geometry, p,
                                                MED_COMPACT_STMODE, name.data(), &chunk.size, at.data(), &chunk.points);
            if (chunk.count == 0) continue;
            chunk.profile = name.c_str();
            chunk.localization = at.c_str();
            step.parts.push_back(read_part(field, step, entity, geometry, type, chunk));
        }
    }

    FieldPart read_part(const Field& field, const FieldStep& step, med_entity_type entity, med_geometry_type geometry,
                        const CellTraits* type, const Chunk& chunk) {
        FieldPart part;
        const std::string who = type ? std::string(med_type(type->type).name) + " elements" : "nodes";
        if (chunk.count < 0 || chunk.points < 1 || chunk.points > 10000)
            throw Unread{"its values on " + who + " are damaged"};
        if (type) part.type = type->type;
        part.points = static_cast<int>(chunk.points);
        part.localization = chunk.localization;
        if (entity == MED_NODE) {
            if (part.points != 1) throw Unread{"it has several values per node"};
            part.localization.clear();
        } else if (entity == MED_NODE_ELEMENT || chunk.localization == MED_GAUSS_ELNO) {
            part.support = FieldSupport::element_nodes;
            if (part.points != type->nodes)
                throw Unread{"it has " + std::to_string(part.points) + " values per element on " + who +
                             ", which have " + std::to_string(type->nodes) + " nodes"};
        } else {
            const bool one = part.points == 1 && chunk.localization.empty();
            part.support = one ? FieldSupport::element : FieldSupport::element_points;
        }
        if (!part.localization.empty() && part.localization != MED_GAUSS_ELNO) read_localization(part);
        choose(part, type, chunk, who);
        read_values(field, step, entity, geometry, part, chunk.profile, who);
        if (part.support == FieldSupport::element_nodes) reorder(part, field.components.size());
        return part;
    }

    void read_localization(FieldPart& part) {
        if (const FieldLocalization* known = out_->localization(part.localization)) {
            if (known->type != part.type || known->weights.size() != static_cast<std::size_t>(part.points))
                throw Unread{"its localization '" + part.localization + "' is of another kind"};
            return;
        }
        FieldLocalization out{part.localization, part.type, 0, {}, {}, {}};
        med_geometry_type geometry = MED_NONE, section_type = MED_NONE;
        med_int dimension = 0, points = 0, sections = 0;
        std::string interpolation(text_size, '\0'), section(text_size, '\0');
        if (MEDlocalizationInfoByName(fid_, out.name.c_str(), &geometry, &dimension, &points, interpolation.data(),
                                      section.data(), &sections, &section_type) < 0)
            throw Unread{"its localization '" + out.name + "' is not in the file, or damaged"};
        if (geometry != med_type(part.type).geometry || points != part.points || dimension < 1 || dimension > 3)
            throw Unread{"its localization '" + out.name + "' is of another kind"};
        if (sections > 0) throw Unread{"its localization '" + out.name + "' has sections of structure elements"};
        const auto nodes = static_cast<std::size_t>(traits(part.type).nodes), d = static_cast<std::size_t>(dimension),
                   n = static_cast<std::size_t>(points);
        const std::string at = "/GAUSS/" + out.name + "/";
        if (size_of(at + "COO") != nodes * d || size_of(at + "GAU") != n * d || size_of(at + "VAL") != n)
            throw Unread{"its localization '" + out.name + "' is damaged"};
        out.dimension = static_cast<int>(dimension);
        std::vector<double> element(nodes * d);
        out.points.resize(n * d);
        out.weights.resize(n);
        if (MEDlocalizationRd(fid_, out.name.c_str(), MED_FULL_INTERLACE, element.data(), out.points.data(),
                              out.weights.data()) < 0)
            throw Unread{"its localization '" + out.name + "' is damaged"};
        const MedType& type = med_type(part.type);
        for (std::size_t k = 0; k < nodes; ++k)
            for (std::size_t a = 0; a < d; ++a)
                out.element.push_back(element[static_cast<std::size_t>(type.order[k]) * d + a]);
        out_->localizations.push_back(std::move(out));
    }

    std::size_t size_of(const std::string& path) const { return size_of_dataset(fid_, path); }

    /// The numbers of the entities that have values.
    void choose(FieldPart& part, const CellTraits* type, const Chunk& chunk, const std::string& who) {
        const std::vector<Index>& ids = type ? mesh_.block(type->type).ids : mesh_.node_ids;
        if (chunk.profile.empty()) {
            if (chunk.count != std::ssize(ids))
                throw Unread{"it has values of " + std::to_string(chunk.count) + " " + who + ", the mesh has " +
                             std::to_string(ids.size())};
            auto& all = all_[type ? static_cast<int>(type->type) : -1];
            if (!all) all = std::make_shared<const std::vector<Index>>(ids);
            part.numbers = all;
            return;
        }
        part.profile = chunk.profile;
        auto& known = chosen_[{type ? static_cast<int>(type->type) : -1, chunk.profile}];
        if (!known) {
            std::vector<Index> numbers;
            for (const med_int place : profile(chunk)) {
                if (place < 1 || place > std::ssize(ids))
                    throw Unread{"its profile '" + chunk.profile + "' names number " + std::to_string(place) + " of " +
                                 std::to_string(ids.size()) + " " + who};
                numbers.push_back(ids[static_cast<std::size_t>(place - 1)]);
            }
            std::vector<Index> sorted = numbers;
            std::ranges::sort(sorted);
            if (std::ranges::adjacent_find(sorted) != sorted.end())
                throw Unread{"its profile '" + chunk.profile + "' names the same twice"};
            known = std::make_shared<const std::vector<Index>>(std::move(numbers));
        }
        part.numbers = known;
    }

    std::vector<med_int> profile(const Chunk& chunk) const {
        const std::size_t size = size_of("/PROFILS/" + chunk.profile + "/PFL");
        if (size != static_cast<std::size_t>(chunk.size) || chunk.count != chunk.size ||
            size * sizeof(med_int) > source_.largest_array)
            throw Unread{"its profile '" + chunk.profile + "' is damaged"};
        std::vector<med_int> out(size);
        if (MEDprofileRd(fid_, chunk.profile.c_str(), out.data()) < 0)
            throw Unread{"its profile '" + chunk.profile + "' is damaged"};
        return out;
    }

    template <class Stored, class Kept>
    void read_as(const Field& field, const FieldStep& step, med_entity_type entity, med_geometry_type geometry,
                 const std::string& profile, const std::string& who, std::size_t count, std::vector<Kept>& out) {
        if (count * sizeof(Stored) > source_.largest_array) throw Unread{"its values on " + who + " are damaged"};
        std::vector<Stored> raw(count);
        const auto number = static_cast<med_int>(step.number), iteration = static_cast<med_int>(step.iteration);
        auto* const bytes = reinterpret_cast<unsigned char*>(raw.data());
        const med_err read =
            source_.old ? MEDfield23ValueWithProfileRd(fid_, field.name.c_str(), number, iteration, entity, geometry,
                                                       source_.mesh.c_str(), MED_COMPACT_STMODE, profile.c_str(),
                                                       MED_FULL_INTERLACE, MED_ALL_CONSTITUENT, bytes)
                        : MEDfieldValueWithProfileRd(fid_, field.name.c_str(), number, iteration, entity, geometry,
                                                     MED_COMPACT_STMODE, profile.c_str(), MED_FULL_INTERLACE,
                                                     MED_ALL_CONSTITUENT, bytes);
        if (read < 0) throw Unread{"its values on " + who + " are damaged"};
        out.assign(raw.begin(), raw.end());
    }

    void read_values(const Field& field, const FieldStep& step, med_entity_type entity, med_geometry_type geometry,
                     FieldPart& part, const std::string& profile, const std::string& who) {
        const std::size_t count =
            part.numbers->size() * static_cast<std::size_t>(part.points) * field.components.size();
        const auto as = [&]<class Stored>(Stored, auto& out) {
            read_as<Stored>(field, step, entity, geometry, profile, who, count, out);
        };
        switch (field.values) {
            case FieldValues::float64:
                as(double(), part.reals);
                break;
            case FieldValues::float32:
                as(float(), part.reals);
                break;
            case FieldValues::int32:
                as(std::int32_t(), part.integers);
                break;
            case FieldValues::int64:
                as(std::int64_t(), part.integers);
                break;
        }
    }

    /// From MED's order of an element's nodes to ours.
    static void reorder(FieldPart& part, std::size_t components) {
        const MedType& type = med_type(part.type);
        const auto nodes = static_cast<std::size_t>(part.points);
        const auto change = [&](auto& values) {
            const auto old = values;
            for (std::size_t e = 0; e < old.size() / (nodes * components); ++e)
                for (std::size_t k = 0; k < nodes; ++k)
                    for (std::size_t c = 0; c < components; ++c)
                        values[(e * nodes + k) * components + c] =
                            old[(e * nodes + static_cast<std::size_t>(type.order[k])) * components + c];
        };
        change(part.reals);
        change(part.integers);
    }

    const MedFieldSource& source_;
    med_idt fid_;
    Mesh& mesh_;
    std::shared_ptr<Fields> out_ = std::make_shared<Fields>();
    std::map<int, std::shared_ptr<const std::vector<Index>>> all_;
    std::map<std::pair<int, std::string>, std::shared_ptr<const std::vector<Index>>> chosen_;
};

}  // namespace

std::shared_ptr<const Fields> read_med_fields(const MedFieldSource& source, Mesh& mesh) {
    return MedFieldReader(source, mesh).read();
}

}  // namespace femscalpel
