// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/report.h"

#include <algorithm>

namespace femscalpel {

QualitySummary summarise(std::vector<ElementQuality> qualities) {
    QualitySummary s;
    s.count = static_cast<Index>(qualities.size());
    double sum = 0;
    for (const ElementQuality& q : qualities) {
        s.minimum = std::min(s.minimum, q.mean_ratio);
        sum += q.mean_ratio;
        const int bar = std::clamp(static_cast<int>(q.mean_ratio * quality_bars), 0, quality_bars - 1);
        ++s.histogram[bar];
    }
    if (s.count > 0) s.mean = sum / static_cast<double>(s.count);
    const auto worst = qualities.begin() + std::min<std::ptrdiff_t>(10, static_cast<std::ptrdiff_t>(qualities.size()));
    std::ranges::partial_sort(qualities, worst, {},
                              [](const ElementQuality& q) { return std::pair(q.mean_ratio, q.id); });
    s.worst.assign(qualities.begin(), worst);
    return s;
}

}  // namespace femscalpel
