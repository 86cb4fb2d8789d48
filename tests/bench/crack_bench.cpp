// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Time and memory of the reference crack of the design: two glued boxes, plane normal (0.9, 0.3, 0.2) through
// (7.3, 5, 5), at 39 k, 505 k and (after `cmake --build ... --target femscalpel_large_mesh`) 2.5 M tetrahedra;
// and of the reference holes. And of a crack through hexahedra, beside the same through tetrahedra.
#include <benchmark/benchmark.h>
#include <malloc.h>

#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <new>
#include <random>

#include "io/io.h"
#include "operators/crack.h"
#include "operators/cut.h"
#include "operators/drill.h"
#include "operators/refine.h"
#include "operators/scalpel.h"
#include "reference_holes.h"
#include "tools/cylinder.h"
#include "tools/plane.h"

namespace {

bool counting = false;  // only while memory is measured, so that it does not cost time elsewhere
std::atomic<long> bytes_now{0};
std::atomic<long> bytes_peak{0};

void note(long bytes) {
    const long now = bytes_now += bytes;
    long peak = bytes_peak;
    while (now > peak && !bytes_peak.compare_exchange_weak(peak, now)) {
    }
}

}  // namespace

// Counted allocation, so that the engine's own memory can be told from the input mesh and the process. Inlined, the
// pairs confuse GCC.
#if defined(__GNUC__)
#pragma GCC diagnostic ignored "-Wmismatched-new-delete"
#endif
void* operator new(std::size_t size) {
    void* p = std::malloc(size);
    if (!p) throw std::bad_alloc();
    if (counting) note(static_cast<long>(malloc_usable_size(p)));
    return p;
}
void operator delete(void* p) noexcept {
    if (p && counting) note(-static_cast<long>(malloc_usable_size(p)));
    std::free(p);
}
void operator delete(void* p, std::size_t) noexcept { operator delete(p); }

namespace femscalpel {
namespace {

const Plane reference_plane({7.3, 5, 5}, {0.9, 0.3, 0.2});

std::shared_ptr<const Mesh> mesh_of(const std::string& name) {
    static std::map<std::string, std::shared_ptr<const Mesh>> known;
    auto& mesh = known[name];
    if (!mesh) mesh = std::make_shared<Mesh>(read(std::filesystem::path(FEMSCALPEL_TEST_MESHES) / (name + ".inp")));
    return mesh;
}

void report(benchmark::State& state, const Mesh& mesh, const Report& r) {
    state.counters["tetra"] = static_cast<double>(mesh.block(CellType::tetra).size());
    state.counters["band"] = static_cast<double>(r.quality_after.count);
    state.counters["min_quality"] = r.quality_after.minimum;
    state.counters["new_nodes"] = static_cast<double>(r.nodes_split);
}

/// A cube of so many hexahedra along an edge, as they are or each cut into six tetrahedra.
Mesh cube_of(int n, bool tetrahedra) {
    Mesh mesh;
    const auto number = [&](int i, int j, int k) { return Index{i} + (n + 1) * (Index{j} + (n + 1) * Index{k}); };
    for (int k = 0; k <= n; ++k)
        for (int j = 0; j <= n; ++j)
            for (int i = 0; i <= n; ++i) mesh.add_node(Vec3(i, j, k), mesh.node_count() + 1);
    constexpr int parts[6][4] = {{0, 1, 2, 6}, {0, 2, 3, 6}, {0, 3, 7, 6}, {0, 7, 4, 6}, {0, 4, 5, 6}, {0, 5, 1, 6}};
    Index next = 1;
    for (int k = 0; k < n; ++k)
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i) {
                std::array<Index, 8> c{};
                for (int q = 0; q < 8; ++q)
                    c[q] = number(i + (q % 4 == 1 || q % 4 == 2 ? 1 : 0), j + q % 4 / 2, k + q / 4);
                if (!tetrahedra) mesh.add_cell(CellType::hexahedron, c, next++);
                for (const auto& p : parts)
                    if (tetrahedra)
                        mesh.add_cell(CellType::tetra, std::array<Index, 4>{c[p[0]], c[p[1]], c[p[2]], c[p[3]]},
                                      next++);
            }
    return mesh;
}

/// A slanted crack through 512 k hexahedra, of which those near it are converted, or through tetrahedra of these.
void BM_crack_cube(benchmark::State& state, bool tetrahedra) {
    const Mesh mesh = cube_of(80, tetrahedra);
    Report last;
    for (auto _ : state) last = crack(mesh, Plane({40.3, 40, 40}, {0.9, 0.3, 0.2})).report;
    report(state, mesh, last);
}

void BM_crack(benchmark::State& state, const std::string& name) {
    const auto mesh = mesh_of(name);
    Report last;
    for (auto _ : state) last = crack(*mesh, reference_plane).report;
    report(state, *mesh, last);
    bytes_now = bytes_peak = 0;
    counting = true;
    benchmark::DoNotOptimize(crack(*mesh, reference_plane));
    counting = false;
    state.counters["bytes_per_tetra"] =
        static_cast<double>(bytes_peak) / static_cast<double>(mesh->block(CellType::tetra).size());
}

/// A further plane position on the same mesh, as in a preview.
void BM_session(benchmark::State& state, const std::string& name) {
    const Scalpel scalpel(mesh_of(name));
    Report last;
    double offset = 0;
    for (auto _ : state) {
        offset += 0.01;
        last = crack(scalpel.mesh(), Plane({7.3 + offset, 5, 5}, {0.9, 0.3, 0.2}), {}, scalpel.prepared()).report;
    }
    report(state, scalpel.mesh(), last);
}

/// The same, making only what a preview shows.
void BM_preview(benchmark::State& state, const std::string& name) {
    const Scalpel scalpel(mesh_of(name));
    CrackOptions options;
    options.band_only = true;
    Report last;
    double offset = 0;
    for (auto _ : state) {
        offset += 0.01;
        last = crack(scalpel.mesh(), Plane({7.3 + offset, 5, 5}, {0.9, 0.3, 0.2}), options, scalpel.prepared()).report;
    }
    report(state, scalpel.mesh(), last);
}

/// A cylinder as thin as two edges of the 39 k mesh, refined to half its radius.
void BM_refine(benchmark::State& state, const std::string& name) {
    const auto mesh = mesh_of(name);
    const Cylinder cylinder({6, 5, 5}, {0, 0, 1}, 0.6);
    const DistanceField distance = distance_to(std::vector<const Tool*>{&cylinder});
    RefineOptions options;
    options.size = 0.3;
    Report last;
    for (auto _ : state) last = refine(*mesh, distance, options).report;
    report(state, *mesh, last);
    state.counters["new_elements"] = static_cast<double>(last.elements_added);
}

/// A reference hole, with the refinement that comes first where it is finer than the mesh. Deviations of the removed
/// volume from the cylinder's are in per cent, distances in the mesh's unit.
void BM_drill(benchmark::State& state, const std::string& name, const checks::ReferenceHole& hole) {
    const auto mesh = mesh_of(name);
    const Cylinder cylinder(hole.origin, hole.axis, hole.radius);
    const Tool* tool = &cylinder;
    Result last;
    for (auto _ : state) last = drill(*mesh, {&tool, 1});
    const checks::HoleMeasures m = checks::measure(hole, *mesh, last.mesh);
    report(state, *mesh, last.report);
    state.counters["volume_%"] = 100 * m.volume_error;
    state.counters["off_wall"] = m.off_wall;
    state.counters["off_border"] = m.off_border;
    state.counters["refined_to"] = last.report.refinement ? last.report.refinement->size : 0;
}

/// The reference mesh with so many more overlapping groups. Every other one holds the whole middle of the model,
/// so that each element near the crack is in half of them; the rest are random boxes elsewhere. All borders are
/// away from the crack: only the number of groups differs, not the geometry to be kept.
void BM_crack_with_groups(benchmark::State& state) {
    Mesh mesh = *mesh_of("two_boxes_505k");
    const CellBlock& tetras = mesh.block(CellType::tetra);
    std::vector<GroupMembers> members;
    for (std::size_t g = 0; g < mesh.groups.size(); ++g)
        members.push_back(group_members(mesh, static_cast<GroupIndex>(g)));
    std::mt19937 random(1);
    std::uniform_real_distribution<double> far_end(14, 19);
    for (Index g = 0; g < state.range(0); ++g) {
        mesh.add_group("ZONE" + std::to_string(g), GroupKind::element);
        const double from = g % 2 == 0 ? 2 : far_end(random), to = g % 2 == 0 ? 12.5 : from + 1;
        GroupMembers m{GroupKind::element, {}, {}};
        for (Index c = 0; c < tetras.size(); ++c)
            if (const double x = mesh.points[tetras.nodes(c)[0]].x(); x > from && x < to)
                m.ids.push_back(tetras.ids[c]);
        members.push_back(std::move(m));
    }
    assign_groups(mesh, members);
    Report last;
    for (auto _ : state) last = crack(mesh, reference_plane).report;
    report(state, mesh, last);
    state.counters["groups"] = static_cast<double>(mesh.groups.size());
}

}  // namespace
}  // namespace femscalpel

int main(int argc, char** argv) {
    using namespace femscalpel;
    for (const char* name : {"two_boxes_39k", "two_boxes_505k", "two_boxes_2500k"}) {
        if (!std::filesystem::exists(std::filesystem::path(FEMSCALPEL_TEST_MESHES) / (std::string(name) + ".inp")))
            continue;
        benchmark::RegisterBenchmark((std::string("crack/") + name).c_str(), BM_crack, name)
            ->Unit(benchmark::kMillisecond);
        benchmark::RegisterBenchmark((std::string("refine/") + name).c_str(), BM_refine, name)
            ->Unit(benchmark::kMillisecond);
        benchmark::RegisterBenchmark((std::string("session/") + name).c_str(), BM_session, name)
            ->Unit(benchmark::kMillisecond);
        benchmark::RegisterBenchmark((std::string("preview/") + name).c_str(), BM_preview, name)
            ->Unit(benchmark::kMillisecond);
        for (const checks::ReferenceHole& hole : checks::reference_holes)
            benchmark::RegisterBenchmark(("drill/" + std::string(name) + "/" + hole.name).c_str(), BM_drill, name, hole)
                ->Unit(benchmark::kMillisecond);
    }
    for (const bool tetrahedra : {false, true})
        benchmark::RegisterBenchmark(tetrahedra ? "crack_cube/tetrahedra" : "crack_cube/hexahedra", BM_crack_cube,
                                     tetrahedra)
            ->Unit(benchmark::kMillisecond);
    benchmark::RegisterBenchmark("crack_with_groups", BM_crack_with_groups)
        ->Arg(5)
        ->Arg(500)
        ->Unit(benchmark::kMillisecond);
    benchmark::Initialize(&argc, argv);
    benchmark::RunSpecifiedBenchmarks();
}
