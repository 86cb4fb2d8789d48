// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cmath>

namespace femscalpel {

/// Where between 0 and 1 `value(t)` is 0, to within `enough` of it, given that it is `at_0` and `at_1` there, of
/// different signs. `value` is called last at the t returned. Regula falsi where the value at the end that stays
/// counts half from the next step on, so that both ends close in (after the Illinois variant, Dowell and Jarratt, BIT
/// 11, 1971, which halves it when an end stays twice): exact in one step where the value is linear.
double root_between(double at_0, double at_1, double enough, auto value) {
    double t = 0, low = 0, high = 1;
    for (int i = 0; i < 100; ++i) {
        t = low + (high - low) * at_0 / (at_0 - at_1);
        const double now = value(t);
        if (std::abs(now) <= enough) break;
        if ((now < 0) == (at_0 < 0)) {
            low = t;
            at_0 = now;
            at_1 /= 2;
        } else {
            high = t;
            at_1 = now;
            at_0 /= 2;
        }
    }
    return t;
}

}  // namespace femscalpel
