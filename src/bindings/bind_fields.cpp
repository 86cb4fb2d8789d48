// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fields/field.h"

#include <pybind11/stl.h>

#include <memory>

#include "arrays.h"
#include "bindings.h"
#include "interruptible.h"

namespace py = pybind11;

namespace femscalpel::bindings {
namespace {

constexpr const char* value_types[] = {"float64", "float32", "int32", "int64"};

template <class T>
py::array_t<T> values_of(const std::vector<T>& values, const FieldPart& part, std::size_t components,
                         const py::object& owner) {
    std::vector<py::ssize_t> shape{part.size()};
    if (part.support == FieldSupport::element_nodes || part.support == FieldSupport::element_points)
        shape.push_back(part.points);
    shape.push_back(static_cast<py::ssize_t>(components));
    return view(values.data(), shape, owner);
}

/// (support, element type or "", numbers, values, localization, profile)
py::tuple to_python(const Field& field, const FieldPart& part, const py::object& owner) {
    const bool of_nodes = part.support == FieldSupport::node;
    const py::object values = field.whole() ? py::object(values_of(part.integers, part, field.components.size(), owner))
                                            : py::object(values_of(part.reals, part, field.components.size(), owner));
    return py::make_tuple(std::string(to_string(part.support)),
                          of_nodes ? std::string() : std::string(traits(part.type).name),
                          view(part.numbers->data(), {part.size()}, owner), values, part.localization, part.profile);
}

py::list fields_of(const Mesh& mesh) {
    py::list out;
    if (!mesh.fields) return out;
    using Shared = std::shared_ptr<const Fields>;
    const py::capsule owner(new Shared(mesh.fields), [](void* p) { delete static_cast<Shared*>(p); });
    for (const Field& field : mesh.fields->fields) {
        py::list steps;
        for (const FieldStep& step : field.steps) {
            py::list parts;
            for (const FieldPart& part : step.parts) parts.append(to_python(field, part, owner));
            steps.append(py::make_tuple(step.number, step.iteration, step.time, parts));
        }
        out.append(py::make_tuple(field.name, field.components, field.units, field.time_unit,
                                  value_types[static_cast<int>(field.values)], steps));
    }
    return out;
}

py::list localizations_of(const Mesh& mesh) {
    py::list out;
    if (mesh.fields)
        for (const FieldLocalization& l : mesh.fields->localizations)
            out.append(py::make_tuple(l.name, std::string(traits(l.type).name), l.dimension, copied<double>(l.element),
                                      copied<double>(l.points), copied<double>(l.weights)));
    return out;
}

FieldPart part_from(const Field& field, const py::tuple& given) {
    FieldPart part;
    const auto support = given[0].cast<std::string>();
    bool known = false;
    for (const FieldSupport s :
         {FieldSupport::node, FieldSupport::element, FieldSupport::element_nodes, FieldSupport::element_points})
        if (to_string(s) == support) part.support = s, known = true;
    if (!known)
        throw Error("field '" + field.name + "': unknown support '" + support +
                    "': it must be 'node', 'element', 'element nodes' or 'element points'");
    if (part.support != FieldSupport::node) part.type = cell_type_from_name(given[1].cast<std::string>());
    part.numbers = std::make_shared<const std::vector<Index>>(to_vector(given[2].cast<IndexArray>()));
    part.points = given[3].cast<int>();
    if (field.whole()) {
        part.integers = to_vector(given[4].cast<IndexArray>());
    } else {
        const auto values = given[4].cast<RealArray>();
        part.reals.assign(values.data(), values.data() + values.size());
        // What a file is to hold is what is shown.
        if (field.values == FieldValues::float32)
            for (double& value : part.reals) value = static_cast<float>(value);
    }
    part.localization = given[5].cast<std::string>();
    part.profile = given[6].cast<std::string>();
    return part;
}

Field field_from(const py::tuple& given) {
    Field field;
    field.name = given[0].cast<std::string>();
    field.components = given[1].cast<std::vector<std::string>>();
    field.units = given[2].cast<std::vector<std::string>>();
    field.time_unit = given[3].cast<std::string>();
    const auto type = given[4].cast<std::string>();
    bool known = false;
    for (int k = 0; k < 4; ++k)
        if (type == value_types[k]) field.values = static_cast<FieldValues>(k), known = true;
    if (!known) throw Error("field '" + field.name + "': unknown type of values '" + type + "'");
    for (const py::handle step : given[5]) {
        const auto s = step.cast<py::tuple>();
        FieldStep& out = field.steps.emplace_back();
        out.number = s[0].cast<Index>();
        out.iteration = s[1].cast<Index>();
        out.time = s[2].cast<double>();
        for (const py::handle part : s[3]) out.parts.push_back(part_from(field, part.cast<py::tuple>()));
    }
    return field;
}

void set_fields(Mesh& mesh, const py::list& fields, const py::list& localizations) {
    auto out = std::make_shared<Fields>();
    for (const py::handle l : localizations) {
        const auto given = l.cast<py::tuple>();
        const auto values = [&](std::size_t k) {
            const auto array = given[k].cast<RealArray>();
            return std::vector<double>(array.data(), array.data() + array.size());
        };
        out->localizations.push_back({given[0].cast<std::string>(), cell_type_from_name(given[1].cast<std::string>()),
                                      given[2].cast<int>(), values(3), values(4), values(5)});
    }
    for (const py::handle field : fields) out->fields.push_back(field_from(field.cast<py::tuple>()));
    interruptible([&] { validate(*out, mesh); });
    mesh.fields = out->fields.empty() ? nullptr : out;
}

}  // namespace

void bind_fields(py::class_<Mesh, std::shared_ptr<Mesh>>& mesh) {
    mesh.def("fields", &fields_of)
        .def("localizations", &localizations_of)
        .def("set_fields", &set_fields, py::arg("fields"), py::arg("localizations"));
}

}  // namespace femscalpel::bindings
