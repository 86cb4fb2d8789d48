// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deck/rules/surface_pairs.h"

namespace femscalpel {

bool SurfacePairs::takes(const Card& card) const { return card.keyword == "TIE" || card.keyword == "CONTACTPAIR"; }

}  // namespace femscalpel
