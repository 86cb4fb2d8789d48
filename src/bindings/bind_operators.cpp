// SPDX-License-Identifier: LGPL-2.1-or-later
#include <pybind11/functional.h>
#include <pybind11/stl.h>

#include <array>
#include <memory>
#include <optional>
#include <utility>

#include "arrays.h"
#include "bindings.h"
#include "interruptible.h"
#include "operators/crack.h"
#include "operators/crack_faces.h"
#include "operators/cut.h"
#include "operators/drill.h"
#include "operators/fillet.h"
#include "operators/merge.h"
#include "operators/refine.h"
#include "operators/reshape.h"
#include "operators/scalpel.h"

namespace py = pybind11;

namespace femscalpel::bindings {
namespace {

py::dict to_dict(const QualitySummary& quality) {
    py::dict out;
    out["count"] = quality.count;
    out["minimum"] = quality.minimum;
    out["mean"] = quality.mean;
    out["histogram"] = copied<Index>(quality.histogram);
    py::list worst;
    for (const ElementQuality& e : quality.worst) worst.append(py::make_tuple(e.id, e.mean_ratio));
    out["worst"] = worst;
    return out;
}

py::dict to_dict(const GroupRecord& record) {
    py::dict out;
    out["name"] = record.name;
    out["kind"] = std::string(to_string(record.kind));
    out["dimension"] = record.dimension;
    out["count_before"] = record.count_before;
    out["count_after"] = record.count_after;
    out["measure_before"] = record.measure_before;
    out["measure_after"] = record.measure_after;
    out["nodes_moved"] = record.nodes_moved;
    out["boundary_kept"] = record.boundary_kept;
    out["boundary_drift"] = record.boundary_drift;
    out["nodes_on_surface"] = record.nodes_on_surface;
    out["nodes_on_line"] = record.nodes_on_line;
    out["nodes_fixed"] = record.nodes_fixed;
    out["status"] = record.status;
    return out;
}

py::dict to_dict(const Report& report) {
    py::dict out;
    out["operation"] = report.operation;
    out["name"] = report.name;
    out["method"] = report.method;
    out["transition"] = report.transition;
    py::dict node_sets;
    for (const auto& [name, ids] : report.node_sets) node_sets[py::str(name)] = copied<Index>(ids);
    out["node_sets"] = node_sets;
    out["constraints"] = py::cast(report.constraints);
    out["quality_before"] = to_dict(report.quality_before);
    out["quality_after"] = to_dict(report.quality_after);
    py::list groups;
    for (const GroupRecord& record : report.groups) groups.append(to_dict(record));
    out["groups"] = groups;
    py::dict held;
    held["count"] = report.held.count;
    held["largest"] = report.held.largest;
    held["groups"] = report.held.groups;
    held["features"] = report.held.features;
    out["held"] = held;
    py::dict straightened;
    straightened["count"] = report.straightened.count;
    straightened["largest"] = report.straightened.largest;
    out["straightened"] = straightened;
    py::list poor;
    for (const PoorPlace& p : report.poor) {
        py::dict place;
        place["elements"] = p.elements;
        place["mean_ratio"] = p.mean_ratio;
        place["place"] = py::make_tuple(p.place[0], p.place[1], p.place[2]);
        place["groups"] = p.groups;
        place["features"] = p.features;
        place["gap"] = p.gap;
        place["room"] = p.room;
        poor.append(place);
    }
    out["poor"] = poor;
    py::list fields;
    for (const FieldRecord& r : report.fields)
        fields.append(py::make_tuple(r.name, std::string(to_string(r.support)), r.steps, r.kept, r.doubled, r.parts,
                                     r.made, r.outside, r.absent, r.removed, r.farthest));
    out["fields"] = fields;
    out["refinement"] = py::none();
    if (const auto& r = report.refinement)
        out["refinement"] = py::make_tuple(r->size, r->elements_before, r->elements_after);
    out["welded_pairs"] = report.welded_pairs;
    py::dict converted;
    for (const auto& [type, count] : report.converted) converted[py::str(type)] = count;
    out["converted"] = converted;
    out["beams_cut"] = report.beams_cut;
    out["nodes_added"] = report.nodes_added;
    out["nodes_split"] = report.nodes_split;
    out["nodes_doubled"] = report.nodes_doubled;
    out["nodes_moved"] = report.nodes_moved;
    out["nodes_removed"] = report.nodes_removed;
    out["elements_added"] = report.elements_added;
    out["elements_removed"] = report.elements_removed;
    out["max_displacement"] = report.max_displacement;
    py::dict seconds;
    for (const auto& [step, s] : report.seconds) seconds[py::str(step)] = s;
    out["seconds"] = seconds;
    out["warnings"] = report.warnings;
    return out;
}

/// An operator's own options with those that all have.
template <class Options>
Options with(const OperatorOptions& common) {
    Options out;
    static_cast<OperatorOptions&>(out) = common;
    return out;
}

/// Runs `operation` without the interpreter lock and returns (mesh, report as a dict).
template <class Operation>
py::tuple run(Operation operation) {
    const auto [mesh, report] = interruptible([&] {
        Result result = operation();
        return std::pair(std::make_shared<Mesh>(std::move(result.mesh)), std::move(result.report));
    });
    return py::make_tuple(mesh, to_dict(report));
}

using Tools = std::vector<const Tool*>;

void bind_estimate(py::module_& module) {
    py::class_<RefinementEstimate>(module, "RefinementEstimate",
                                   "What refining a mesh will come to, told before it is done.")
        .def_readonly("size", &RefinementEstimate::size, "Longest edge wanted.")
        .def_readonly("elements_before", &RefinementEstimate::elements_before, "Elements of the mesh.")
        .def_readonly("elements_after", &RefinementEstimate::elements_after,
                      "Elements that it would have, some 25 % more or fewer.")
        .def_readonly("is_more", &RefinementEstimate::is_more,
                      "Whether counting ended at `elements_after`: there would be more.")
        .def("size_for", &RefinementEstimate::size_for, py::arg("limit"), py::call_guard<py::gil_scoped_release>(),
             "The smallest length, rounded up to two digits, to which the mesh can be refined there with at most "
             "`limit` elements; infinity where it has more already. RuntimeError once the function that was given "
             "the estimate has returned.");
}

/// Members are called as in options.py, whose functions check what they are set to.
void bind_options(py::module_& module) {
    const auto refine = [](const OperatorOptions& o) -> std::optional<double> {
        if (o.refine.when == RefineFirst::When::automatic) return {};
        return o.refine.when == RefineFirst::When::never ? 0 : o.refine.size;
    };
    const auto set_refine = [](OperatorOptions& o, std::optional<double> size) {
        o.refine = {};
        if (size) o.refine = {*size > 0 ? RefineFirst::When::to_size : RefineFirst::When::never, *size};
    };
    py::class_<OperatorOptions>(module, "Options", "What every operator lets its user choose.")
        .def(py::init<>())
        .def_readwrite("name", &OperatorOptions::name)
        .def_property(
            "method", [](const OperatorOptions& o) { return std::string(to_string(o.method)); },
            [](OperatorOptions& o, const std::string& method) { o.method = method_from_name(method); })
        .def_readwrite("transition", &OperatorOptions::transition)
        .def_readwrite("feature_angle", &OperatorOptions::feature_angle)
        .def_readwrite("strict", &OperatorOptions::strict)
        .def_readwrite("preserve", &OperatorOptions::preserve)
        .def_readwrite("band_only", &OperatorOptions::band_only)
        .def_readwrite("second_order", &OperatorOptions::second_order)
        .def_property("refine", refine, set_refine, "Nothing: automatic; 0: never; or a length.")
        .def_readwrite("before_refining", &OperatorOptions::before_refining)
        .def_property(
            "skin", [](const OperatorOptions& o) { return o.skin; },
            py::cpp_function([](OperatorOptions& o, const CadShape* skin) { o.skin = skin; }, py::keep_alive<1, 2>()));
}

/// Binds an operator twice: on a mesh, and on a session, which knows its mesh. `operate` is called with the mesh, what
/// is known of it, and the arguments; `names` are theirs.
template <class... Arguments, class Operate, class... Names>
void bind_operator(py::module_& module, const char* name, Operate operate, Names... names) {
    module.def(
        name,
        [operate](const Mesh& mesh, Arguments... arguments) {
            return run([&] { return operate(mesh, Prepared{}, arguments...); });
        },
        py::arg("mesh"), names...);
    module.def(
        name,
        [operate](const Scalpel& session, Arguments... arguments) {
            return run([&] { return operate(session.mesh(), session.prepared(), arguments...); });
        },
        py::arg("session"), names...);
}

void bind_functions(py::module_& module) {
    bind_operator<const Tool&, const OperatorOptions&, const Within*>(
        module, "crack",
        [](const Mesh& mesh, const Prepared& known, const Tool& tool, const OperatorOptions& options,
           const Within* within) {
            auto o = with<CrackOptions>(options);
            o.within = within;
            return crack(mesh, tool, o, known);
        },
        py::arg("tool"), py::arg("options"), py::arg("within"));
    bind_operator<const std::string&, const OperatorOptions&>(
        module, "crack_along_faces",
        [](const Mesh& mesh, const Prepared& known, const std::string& faces, const OperatorOptions& options) {
            return crack_along_faces(mesh, faces, with<CrackOptions>(options), known);
        },
        py::arg("faces"), py::arg("options"));
    bind_operator<const Tools&, const OperatorOptions&, std::optional<double>>(
        module, "drill",
        [](const Mesh& mesh, const Prepared& known, const Tools& tools, const OperatorOptions& options,
           std::optional<double> depth) {
            auto o = with<DrillOptions>(options);
            o.depth = depth;
            return drill(mesh, tools, o, known);
        },
        py::arg("tools"), py::arg("options"), py::arg("depth"));
    bind_operator<const std::string&, const std::vector<Index>&, const RealArray&, double, const OperatorOptions&>(
        module, "fillet",
        [](const Mesh& mesh, const Prepared& known, const std::string& group, const std::vector<Index>& nodes,
           const RealArray& points, double radius, const OperatorOptions& options) {
            Along along{group, nodes, {}};
            for (py::ssize_t i = 0; i < points.size() / 3; ++i) along.points.emplace_back(points.data() + 3 * i);
            return fillet(mesh, along, radius, with<FilletOptions>(options), known);
        },
        py::arg("group"), py::arg("nodes"), py::arg("points"), py::arg("radius"), py::arg("options"));
    // Two tools, or a plane and a width.
    bind_operator<const Tool&, const Tool&, const OperatorOptions&, const Tool*>(
        module, "cut",
        [](const Mesh& mesh, const Prepared& known, const Tool& positive, const Tool& negative,
           const OperatorOptions& options, const Tool* bottom) {
            auto o = with<CutOptions>(options);
            o.bottom = bottom;
            return cut(mesh, positive, negative, o, known);
        },
        py::arg("positive"), py::arg("negative"), py::arg("options"), py::arg("bottom"));
    bind_operator<const Plane&, double, const OperatorOptions&, const Tool*>(
        module, "cut",
        [](const Mesh& mesh, const Prepared& known, const Plane& plane, double width, const OperatorOptions& options,
           const Tool* bottom) {
            auto o = with<CutOptions>(options);
            o.bottom = bottom;
            return cut(mesh, plane, width, o, known);
        },
        py::arg("plane"), py::arg("width"), py::arg("options"), py::arg("bottom"));
}

void bind_merge(py::module_& module) {
    bind_operator<const Mesh&, const OperatorOptions&, bool, std::optional<double>, const std::string&, bool,
                  std::optional<std::array<double, 3>>, bool>(
        module, "merge",
        [](const Mesh& mesh, const Prepared& known, const Mesh& addition, const OperatorOptions& options,
           bool keep_addition, std::optional<double> tolerance, const std::string& prefix, bool join_groups,
           std::optional<std::array<double, 3>> keep_side, bool tie) {
            auto o = with<MergeOptions>(options);
            o.tie = tie;
            if (keep_side) o.keep_side = Vec3(keep_side->data());
            o.keep_addition = keep_addition;
            o.tolerance = tolerance;
            o.prefix = prefix;
            o.join_groups = join_groups;
            return merge(mesh, addition, o, known);
        },
        py::arg("addition"), py::arg("options"), py::arg("keep_addition"), py::arg("tolerance"), py::arg("prefix"),
        py::arg("join_groups"), py::arg("keep_side"), py::arg("tie"));
}

void bind_refine(py::module_& module) {
    module.def(
        "refine",
        [](const Mesh& mesh, const Tools& tools, const RealArray& points, double size, double gradation, double reach,
           bool relax, Index max_elements, double feature_angle, bool strict, const CadShape* skin,
           const BeforeRefining& before_refining) {
            RefineOptions o;
            o.size = size;
            o.gradation = gradation;
            o.reach = reach;
            o.relax = relax;
            o.max_elements = max_elements;
            o.feature_angle = feature_angle;
            o.strict = strict;
            o.skin = skin;
            o.before = before_refining;
            std::vector<Vec3> at;
            for (py::ssize_t i = 0; i < points.size() / 3; ++i) at.emplace_back(points.data() + 3 * i);
            return run(
                [&] { return refine(mesh, tools.empty() ? distance_to(std::move(at)) : distance_to(tools), o); });
        },
        py::arg("mesh"), py::arg("tools"), py::arg("points"), py::arg("size"), py::arg("gradation"), py::arg("reach"),
        py::arg("relax"), py::arg("max_elements"), py::arg("feature_angle"), py::arg("strict"), py::arg("skin"),
        py::arg("before_refining"));
}

void bind_reshape(py::module_& module) {
    using Three = std::array<double, 3>;
    using Scaling = std::pair<double, Three>;
    bind_operator<const std::string&, const Tool*, std::optional<Three>, std::optional<Scaling>, const std::string&,
                  double, std::optional<std::vector<std::string>>, bool>(
        module, "reshape",
        [](const Mesh& mesh, const Prepared& known, const std::string& group, const Tool* onto,
           const std::optional<Three>& by, const std::optional<Scaling>& scale, const std::string& name,
           double feature_angle, const std::optional<std::vector<std::string>>& preserve, bool strict) {
            ReshapeOptions o;
            o.name = name;
            o.onto = onto;
            if (by) o.by = Vec3(by->data());
            if (scale) o.scale = {scale->first, Vec3(scale->second.data())};
            o.feature_angle = feature_angle;
            o.preserve = preserve;
            o.strict = strict;
            return reshape(mesh, group, o, known);
        },
        py::arg("group"), py::arg("onto"), py::arg("by"), py::arg("scale"), py::arg("name"), py::arg("feature_angle"),
        py::arg("preserve"), py::arg("strict"));
}

void bind_session(py::module_& module) {
    py::class_<Scalpel>(module, "Scalpel")
        // The session gets its own copy, so that groups added to the Python mesh later do not reach it.
        .def(py::init([](const Mesh& mesh) {
                 return interruptible([&] { return Scalpel(std::make_shared<const Mesh>(mesh)); });
             }),
             py::arg("mesh"))
        .def_property_readonly("mesh", [](const Scalpel& scalpel) { return std::make_shared<Mesh>(scalpel.mesh()); });
}

}  // namespace

void bind_operators(py::module_& module) {
    bind_estimate(module);
    bind_options(module);
    bind_session(module);
    bind_functions(module);
    bind_merge(module);
    bind_refine(module);
    bind_reshape(module);
}

}  // namespace femscalpel::bindings
