// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/follow_fields.h"

#include <sstream>

#include "mesh/stopwatch.h"

namespace femscalpel {

void follow_fields(const Mesh& input, bool band_only, Result& result, const std::string& added) {
    result.mesh.fields.reset();
    if (!input.fields || band_only) return;
    const Stopwatch::Time started = Stopwatch::now();
    std::optional<GroupIndex> others;
    if (!added.empty()) others = result.mesh.find_group(added, GroupKind::element);
    Report& report = result.report;
    report.fields.clear();
    result.mesh.fields = carry_fields({input, result.mesh, result.stages, others}, report.fields);
    for (const FieldRecord& r : report.fields) {
        const std::string who = "field '" + r.name + "' (" + std::string(to_string(r.support)) + "): ";
        if (r.absent > 0)
            report.warnings.push_back(who + std::to_string(r.absent) +
                                      " new nodes or elements have no value, as there is none where they are; a file "
                                      "has them outside its profile");
        if (r.outside > 0) {
            std::ostringstream text;
            text << who << r.outside << " values are those of the nearest point of the mesh as it was, up to "
                 << r.farthest << " away: there was nothing where the nodes are now";
            report.warnings.push_back(text.str());
        }
    }
    if (!report.fields.empty()) report.seconds.emplace_back("fields", Stopwatch::since(started));
}

}  // namespace femscalpel
