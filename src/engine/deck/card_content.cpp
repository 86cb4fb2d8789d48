// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deck/card_content.h"

#include <algorithm>
#include <unordered_map>

#include "deck/solver_element.h"

namespace femscalpel {
namespace {

/// Cards whose content depends on the keyword alone. Those that CalculiX has and that name no node or element
/// by number are in `nameless`.
const std::unordered_map<std::string_view, CardContent>& contents() {
    using enum CardContent;
    static const std::unordered_map<std::string_view, CardContent> table = {
        {"NODE", mesh},
        {"ELEMENT", mesh},
        {"NSET", mesh},
        {"ELSET", mesh},
        {"SURFACE", mesh},
        {"BOUNDARY", nodal_dofs},
        {"TEMPERATURE", nodal_values},
        {"NODALTHICKNESS", nodal_values},
        {"CLOAD", node_loads},
        {"CFLUX", node_loads},
        {"DISTRIBUTINGCOUPLING", node_weights},
        {"RETAINEDNODALDOFS", node_weights},
        {"DLOAD", element_loads},
        {"DFLUX", element_loads},
        {"FILM", element_loads},
        {"RADIATE", element_loads},
        {"BOUNDARYF", element_loads},
        {"MASSFLOW", element_loads},
        {"DISTRIBUTION", element_values},
        {"NORMAL", element_normals},
        {"EQUATION", equation},
        {"NETWORKMPC", equation},
        {"EQUATIONF", face_equation},
        {"MPC", mpc},
    };
    return table;
}

constexpr std::string_view nameless[] = {
    "",
    "AMPLITUDE",
    "BASEMOTION",
    "BEAMGENERALSECTION",
    "BEAMSECTION",
    "BUCKLE",
    "CFD",
    "CHANGECONTACTTYPE",
    "CHANGEFRICTION",
    "CHANGEMATERIAL",
    "CHANGEPLASTIC",
    "CHANGESOLIDSECTION",
    "CHANGESURFACEBEHAVIOR",
    "CLEARANCE",
    "COMPLEXFREQUENCY",
    "CONDUCTIVITY",
    "CONSTRAINT",
    "CONTACTDAMPING",
    "CONTACTFILE",
    "CONTACTOUTPUT",
    "CONTACTPAIR",
    "CONTACTPRINT",
    "CONTROLS",
    "CORRELATIONLENGTH",
    "COUPLEDTEMPERATURE-DISPLACEMENT",
    "COUPLING",
    "CRACKPROPAGATION",
    "CREEP",
    "CYCLICHARDENING",
    "CYCLICSYMMETRYMODEL",
    "DAMPING",
    "DASHPOT",
    "DEFORMATIONPLASTICITY",
    "DENSITY",
    "DEPVAR",
    "DESIGNRESPONSE",
    "DESIGNVARIABLES",
    "DISTRIBUTING",
    "DISTRIBUTIONTABLE",
    "DSLOAD",
    "DYNAMIC",
    "ELASTIC",
    "ELECTRICALCONDUCTIVITY",
    "ELECTROMAGNETICS",
    "ELEMENTOUTPUT",
    "ELFILE",
    "ELPRINT",
    "ENDSTEP",
    "EXPANSION",
    "FACEPRINT",
    "FEASIBLEDIRECTION",
    "FILTER",
    "FLUIDCONSTANTS",
    "FLUIDSECTION",
    "FREQUENCY",
    "FRICTION",
    "GAP",
    "GAPCONDUCTANCE",
    "GAPHEATGENERATION",
    "GEOMETRICCONSTRAINT",
    "GEOMETRICTOLERANCE",
    "GREEN",
    "HCF",
    "HEADING",
    "HEATTRANSFER",
    "HYPERELASTIC",
    "HYPERFOAM",
    "INCLUDE",
    "INITIALSTRAININCREASE",
    "KINEMATIC",
    "MAGNETICPERMEABILITY",
    "MASS",
    "MATERIAL",
    "MEMBRANESECTION",
    "MODALDAMPING",
    "MODALDYNAMIC",
    "MOHRCOULOMB",
    "MOHRCOULOMBHARDENING",
    "NOANALYSIS",
    "NODEFILE",
    "NODEOUTPUT",
    "NODEPRINT",
    "OBJECTIVE",
    "ORIENTATION",
    "OUTPUT",
    "PHYSICALCONSTANTS",
    "PLASTIC",
    "PRE-TENSIONSECTION",
    "RANDOMFIELD",
    "REFINEMESH",
    "RIGIDBODY",
    "ROBUSTDESIGN",
    "SECTIONPRINT",
    "SELECTCYCLICSYMMETRYMODES",
    "SENSITIVITY",
    "SHELLSECTION",
    "SOLIDSECTION",
    "SPECIFICGASCONSTANT",
    "SPECIFICHEAT",
    "SPRING",
    "STATIC",
    "STEADYSTATEDYNAMICS",
    "STEP",
    "SUBSTRUCTUREGENERATE",
    "SUBSTRUCTUREMATRIXOUTPUT",
    "SURFACEBEHAVIOR",
    "SURFACEINTERACTION",
    "TIE",
    "TIMEPOINTS",
    "TRANSFORM",
    "TRANSFORMF",
    "UNCOUPLEDTEMPERATURE-DISPLACEMENT",
    "USERELEMENT",
    "USERMATERIAL",
    "USERSECTION",
    "VALUESATINFINITY",
    "VIEWFACTOR",
    "VISCO",
};

std::string type_of(const Card& card) {
    const std::string* type = card.parameter("TYPE");
    return type ? deck_key(*type) : "";
}

}  // namespace

std::optional<CardContent> card_content(const Card& card) {
    if (const auto it = contents().find(card.keyword); it != contents().end()) return it->second;
    if (card.keyword == "INITIALCONDITIONS") {
        const std::string type = type_of(card);
        if (type == "DISPLACEMENT" || type == "VELOCITY" || type == "FLUIDVELOCITY") return CardContent::nodal_dof;
        if (type == "STRESS" || type == "PLASTICSTRAIN" || type == "SOLUTION") return CardContent::element_values;
        return CardContent::nodal_values;
    }
    if (card.keyword == "SUBMODEL") return type_of(card) == "SURFACE" ? CardContent::nothing : CardContent::nodal_list;
    if (card.keyword == "MODELCHANGE")
        return type_of(card) == "ELEMENT" ? CardContent::element_list : CardContent::nothing;
    if (card.keyword == "RESTART") return card.parameter("READ") ? CardContent::foreign_results : CardContent::nothing;
    // CalculiX compares the first letters ("*FLUID SECTIONS").
    const auto is_this = [&](std::string_view known) {
        return known.empty() ? card.keyword.empty() : card.keyword.starts_with(known);
    };
    if (std::ranges::any_of(nameless, is_this)) return CardContent::nothing;
    return {};
}

LoadLabel::LoadLabel(std::string_view label) {
    const auto digit = std::ranges::find_if(label, [](char c) { return c >= '1' && c <= '6'; });
    prefix = deck_key(label.substr(0, static_cast<std::size_t>(digit - label.begin())));
    if (digit == label.end()) return;
    number = *digit - '0';
    suffix = deck_key(label.substr(static_cast<std::size_t>(digit - label.begin()) + 1));
}

int LoadLabel::face(CellType type, bool plane) const {
    const CellTraits& t = traits(type);
    if (number == 0 || t.dimension < 2) return 0;
    const int face = is_edge_load() ? number + 2 : face_from_label(number, plane);
    const int faces = t.dimension == 3 ? static_cast<int>(t.faces.size()) : 2 + t.corners;
    return face >= 1 && face <= faces ? face : 0;
}

std::string LoadLabel::with_face(int face, bool plane) const {
    return prefix + std::to_string(is_edge_load() ? face - 2 : label_from_face(face, plane)) + suffix;
}

}  // namespace femscalpel
