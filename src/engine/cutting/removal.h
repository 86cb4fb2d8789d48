// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <span>
#include <vector>

#include "cutting/opening.h"
#include "cutting/workpiece.h"

namespace femscalpel {

/// Takes the elements on the negative side of all `tools` out of the band, with what only they carried: faces and edges
/// to be kept, attached triangles, segments, points and facets. Faces (edges, for shells) that part them from the rest
/// become BandMesh::cut_faces (cut_edges), with tag `first_tag` plus the place of the tool they lie on.
///
/// Elements must not reach to both sides: cut_along() all tools first. Returns the number of elements removed.
int remove_inside(Workpiece& workpiece, std::span<const Tool* const> tools, int first_tag);

/// Takes these tetrahedra out of the band, with what only they carried. Others may already fill their place
/// (SimplexList::add_part()): what lies on faces and edges of those stays.
void remove_elements(Workpiece& workpiece, const std::vector<int>& tetras);

/// The same with triangles, of shells.
void remove_shells(Workpiece& workpiece, const std::vector<int>& triangles);

/// Nodes keep contact only with the tools of the walls they are on.
void release_all_but_walls(Workpiece& workpiece, std::span<const Tool* const> tool_of_tag);

/// Adds what lies between flat wall faces and their curved tools to Workpiece::taken, times `sign`.
void note_slivers(Workpiece& workpiece, std::span<const Tool* const> tool_of_tag, int sign);

/// The walls as faces without copies; group: the tag.
Opening open_walls(const Workpiece& workpiece);

/// Elements of the mesh with no node in the band (level < 0) and all nodes inside one of the bodies, each given by
/// its signed depth; springs, dashpots and gaps with one end there.
std::vector<CellRef> deep_inside(const Mesh& mesh, const std::vector<std::int8_t>& level,
                                 std::span<const std::function<double(const Vec3&)>> depths);

}  // namespace femscalpel
