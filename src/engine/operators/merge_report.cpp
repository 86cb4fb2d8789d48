// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/merge_report.h"

#include "groups/group_report.h"

namespace femscalpel {

std::vector<GroupRecord> merged_records(const Mesh& input, const Mesh& result, const std::vector<GroupRecord>& known) {
    std::vector<GroupRecord> records = compare_groups(input, family_totals(input), result, family_totals(result));
    for (GroupRecord& r : records)
        for (const GroupRecord& was : known)
            if (was.name == r.name && was.kind == r.kind) {
                const GroupRecord now = r;
                // What is known may be of the last step alone.
                r = was;
                r.count_before = now.count_before;
                r.count_after = now.count_after;
                r.measure_before = now.measure_before;
                r.measure_after = now.measure_after;
                if (was.status == "untouched" && now.count_after != now.count_before) r.status = now.status;
            }
    return records;
}

void add_seam(Mesh& mesh, const std::string& name, const std::vector<Index>& nodes) {
    const GroupIndex group = mesh.add_group(name + "_SEAM", GroupKind::node);
    for (const Index n : nodes) mesh.node_families[n] = mesh.families.with(mesh.node_families[n], group);
}

}  // namespace femscalpel
