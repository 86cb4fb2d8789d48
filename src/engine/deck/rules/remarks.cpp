// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deck/rules/remarks.h"

namespace femscalpel {

void Remarks::add(std::size_t card, Weight weight, const std::string& where, const std::string& entity,
                  const std::string& what) {
    Remark& r = remarks_[{card, weight, what}];
    if (r.count++ == 0) {
        r.where = where;
        r.entity = entity;
    }
}

std::vector<std::string> Remarks::problems() const {
    std::vector<std::string> out = problems_;
    for (std::string& text : texts(Weight::problem)) out.push_back(std::move(text));
    return out;
}

std::vector<std::string> Remarks::texts(Weight weight) const {
    std::vector<std::string> out;
    for (const auto& [key, r] : remarks_) {
        const auto& [card, its_weight, what] = key;
        if (its_weight != weight) continue;
        std::string text = r.where + "*" + deck_.cards()[card].keyword + " names " + r.entity;
        if (r.count > 1)
            text += " and " + std::to_string(r.count - 1) + " more, each of which " + what;
        else
            text += ", which " + what;
        out.push_back(std::move(text));
    }
    return out;
}

}  // namespace femscalpel
