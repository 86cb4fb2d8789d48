// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "deck/rules/card_rule.h"

namespace femscalpel {

/// *NODE, *ELEMENT, *NSET, *ELSET and *SURFACE, which are written from the mesh.
bool is_mesh_card(const Card& card);

/// The cards of the mesh itself. Elements that have no place in the mesh (OtherElement) keep their nodes: these do not
/// move, stay the originals, and a change that removes one is an Error.
class MeshCards : public CardRule {
public:
    bool takes(const Card& card) const override { return is_mesh_card(card); }
    bool can_change(const Card& /*card*/) const override { return false; }
    int names_per_line() const override { return 0; }
    void end_marking(Marking& marking) override;
    void end_carrying(Carrying& carrying) override;
};

}  // namespace femscalpel
