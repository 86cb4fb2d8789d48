// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cutting/meeting_lines.h"
#include "operators/options.h"
#include "operators/prepared.h"
#include "operators/refine_first.h"
#include "tools/ribbon.h"

namespace femscalpel {

/// What is known of two meshes that are merged.
using Knowledge = std::array<Prepared, 2>;

/// Two meshes (0, and the addition 1), each refined along the lines in which they meet where the other is much finer.
class MergeRefining {
public:
    /// All must outlive this.
    MergeRefining(const Mesh& mesh, const Mesh& addition, const OperatorOptions& options);

    /// What `options.refine` asks for: by default edges of the one that are no more than `longer` times as long as the
    /// other's; or edges of a length in both; or nothing. A mesh becomes no more than `growth` times as large.
    ///
    /// Throws ToolError that names `refine` where it would, and as refine_first() does.
    void run(const std::vector<MeetingLine>& meeting, double longer, double growth, const Knowledge& known);

    /// Whether either is another mesh now.
    bool any() const { return is_refined(0) || is_refined(1); }
    const Mesh& mesh(std::size_t m) const { return is_refined(m) ? refined_[m]->mesh : *meshes_[m]; }

    /// Adds what was done to mesh m to a report on what was done then.
    void join(std::size_t m, Report& report) const;

private:
    std::vector<RefineZone> zones(const std::vector<MeetingLine>& meeting, std::size_t m, double longer,
                                  std::vector<std::unique_ptr<Ribbon>>& ribbons) const;
    OperatorOptions options_for(std::size_t m, double growth) const;
    std::optional<Refined> simplify(const Mesh& mesh, std::span<const RefineZone> zones, const Prepared& known) const;
    bool is_refined(std::size_t m) const { return refined_[m] && !refined_[m]->tried_in_vain; }

    std::array<const Mesh*, 2> meshes_;
    OperatorOptions options_;
    std::array<std::optional<Refined>, 2> refined_;
};

}  // namespace femscalpel
