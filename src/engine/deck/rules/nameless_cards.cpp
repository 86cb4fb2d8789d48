// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deck/rules/nameless_cards.h"

#include <algorithm>

namespace femscalpel {
namespace {

struct NamelessCard {
    std::string_view keyword;
    std::string_view since = "";  ///< the first CalculiX that has it, if that is one after 2.20
};

/// Keywords that have a rule of their own stand here, too: for longer ones that start alike. PART, ASSEMBLY and what
/// ends them no CalculiX has; all pass over them. Versions are those of src/calinput.f on the days of release
/// (LOGBOOK).
constexpr NamelessCard nameless[] = {
    {""},
    {"AMPLITUDE"},
    {"ASSEMBLY"},
    {"BASEMOTION"},
    {"BEAMGENERALSECTION"},
    {"BEAMSECTION"},
    {"BUCKLE"},
    {"CFD"},
    {"CHANGECONTACTTYPE", "2.21"},
    {"CHANGEFRICTION"},
    {"CHANGEMATERIAL"},
    {"CHANGEPLASTIC"},
    {"CHANGESOLIDSECTION"},
    {"CHANGESURFACEBEHAVIOR"},
    {"CLEARANCE"},
    {"COMPLEXFREQUENCY"},
    {"CONDUCTIVITY"},
    {"CONSTRAINT"},
    {"CONTACTDAMPING"},
    {"CONTACTFILE"},
    {"CONTACTOUTPUT"},
    {"CONTACTPAIR"},
    {"CONTACTPRINT"},
    {"CONTROLS"},
    {"CORRELATIONLENGTH"},
    {"COUPLEDTEMPERATURE-DISPLACEMENT"},
    {"COUPLING"},
    {"CRACKPROPAGATION"},
    {"CREEP"},
    {"CYCLICHARDENING"},
    {"CYCLICSYMMETRYMODEL"},
    {"DAMAGEINITIATION", "2.23"},
    {"DAMPING"},
    {"DASHPOT"},
    {"DEFORMATIONPLASTICITY"},
    {"DENSITY"},
    {"DEPVAR"},
    {"DESIGNRESPONSE"},
    {"DESIGNVARIABLES"},
    {"DISTRIBUTING"},
    {"DISTRIBUTIONTABLE"},
    {"DSLOAD"},
    {"DYNAMIC"},
    {"ELASTIC"},
    {"ELECTRICALCONDUCTIVITY"},
    {"ELECTROMAGNETICS"},
    {"ELEMENTOUTPUT"},
    {"ELFILE"},
    {"ELPRINT"},
    {"ENDASSEMBLY"},
    {"ENDPART"},
    {"ENDSTEP"},
    {"EXPANSION"},
    {"FACEPRINT"},
    {"FEASIBLEDIRECTION"},
    {"FILTER"},
    {"FLUIDCONSTANTS"},
    {"FLUIDSECTION"},
    {"FREQUENCY"},
    {"FRICTION"},
    {"GAP"},
    {"GAPCONDUCTANCE"},
    {"GAPHEATGENERATION"},
    {"GEOMETRICCONSTRAINT"},
    {"GEOMETRICTOLERANCE"},
    {"GREEN"},
    {"HCF"},
    {"HEADING"},
    {"HEATTRANSFER"},
    {"HYPERELASTIC"},
    {"HYPERFOAM"},
    {"INCLUDE"},
    {"INITIALSTRAININCREASE"},
    {"KINEMATIC"},
    {"MAGNETICPERMEABILITY"},
    {"MASS"},
    {"MATERIAL"},
    {"MATRIXASSEMBLE", "2.21"},
    {"MEMBRANESECTION"},
    {"MODALDAMPING"},
    {"MODALDYNAMIC"},
    {"MOHRCOULOMB", "2.21"},
    {"MOHRCOULOMBHARDENING", "2.21"},
    {"NOANALYSIS"},
    {"NODEFILE"},
    {"NODEOUTPUT"},
    {"NODEPRINT"},
    {"OBJECTIVE"},
    {"ORIENTATION"},
    {"OUTPUT"},
    {"PART"},
    {"PHYSICALCONSTANTS"},
    {"PLASTIC"},
    {"PRE-TENSIONSECTION"},
    {"RANDOMFIELD"},
    {"RATEDEPENDENT", "2.21"},
    {"REFINEMESH"},
    {"RIGIDBODY"},
    {"ROBUSTDESIGN"},
    {"SECTIONPRINT"},
    {"SELECTCYCLICSYMMETRYMODES"},
    {"SENSITIVITY"},
    {"SHELLSECTION"},
    {"SOLIDSECTION"},
    {"SPECIFICGASCONSTANT"},
    {"SPECIFICHEAT"},
    {"SPRING"},
    {"STATIC"},
    {"STEADYSTATEDYNAMICS"},
    {"STEP"},
    {"SUBSTRUCTUREGENERATE"},
    {"SUBSTRUCTUREMATRIXOUTPUT"},
    {"SURFACEBEHAVIOR"},
    {"SURFACEINTERACTION"},
    {"TIE"},
    {"TIMEPOINTS"},
    {"TRANSFORM"},
    {"TRANSFORMF"},
    {"UNCOUPLEDTEMPERATURE-DISPLACEMENT"},
    {"USEREFINEDMESH", "2.23"},
    {"USERELEMENT"},
    {"USERMATERIAL"},
    {"USERSECTION"},
    {"VALUESATINFINITY"},
    {"VIEWFACTOR"},
    {"VISCO"},
};

}  // namespace

bool NamelessCards::takes(const Card& card) const {
    return std::ranges::any_of(nameless, [&](const NamelessCard& known) {
        return known.keyword.empty() ? card.keyword.empty() : card.keyword.starts_with(known.keyword);
    });
}

std::string_view first_calculix_with(std::string_view keyword) {
    const NamelessCard* found = nullptr;  // the longest: *MOHR COULOMB HARDENING is none of *MOHR COULOMB
    for (const NamelessCard& known : nameless)
        if (!known.keyword.empty() && keyword.starts_with(known.keyword) &&
            (!found || known.keyword.size() > found->keyword.size()))
            found = &known;
    return found ? found->since : "";
}

}  // namespace femscalpel
