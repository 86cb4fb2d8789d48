// SPDX-License-Identifier: LGPL-2.1-or-later
#include "io/lost_digits.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "cancel.h"
#include "words.h"

namespace femscalpel {

LostDigits::LostDigits(const Mesh& mesh, const std::function<double(double)>& as_read) {
    SparseCheck check(1 << 12);
    for (Index n = 0; n < mesh.node_count(); ++n, check()) {
        const Vec3& p = mesh.points[static_cast<std::size_t>(n)];
        double most = 0;
        for (int a = 0; a < 3; ++a) most = std::max(most, std::abs(as_read(p[a]) - p[a]));
        if (most == 0) continue;
        nodes.push_back(n);
        off.push_back(most);
    }
}

std::optional<std::string> LostDigits::told() const {
    if (nodes.empty()) return {};
    std::ostringstream text;
    text << "the last digits of the coordinates of " << counted(std::ssize(nodes), "node") << " (they are off by up to "
         << *std::ranges::max_element(off) << ")";
    return text.str();
}

}  // namespace femscalpel
