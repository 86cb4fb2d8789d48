// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cancel.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <thread>

#include "groups/virtual_boundary.h"
#include "io/io.h"
#include "operators/crack.h"
#include "operators/cut.h"
#include "operators/drill.h"
#include "operators/refine.h"
#include "operators/scalpel.h"
#include "simple_meshes.h"
#include "tools/cylinder.h"
#include "tools/patch.h"
#include "tools/plane.h"
#include "tools/torus.h"

namespace fs = std::filesystem;

namespace femscalpel {
namespace FILE_NAMESPACE {

constexpr long never = std::numeric_limits<long>::max();

/// Runs, cancelled at the `last`-th check point of this thread; returns how many there were.
long run_until(long last, const std::function<void()>& run) {
    long count = 0;
    const CancelScope scope(CancelToken(), [&] { return ++count >= last; });
    run();
    return count;
}

/// Cancels at each of its check points, or at 50 of them; `look` is called after each.
void cancel_everywhere(
    const std::function<void()>& run, const std::function<void()>& look = [] {}) {
    const long count = run_until(never, run);
    ASSERT_GT(count, 0) << "no check point";
    const long step = 1 + count / 50;
    for (long k = 1; k <= count; k += step) {
        EXPECT_THROW(run_until(k, run), Cancelled) << "at check point " << k << " of " << count;
        look();
    }
}

void expect_same(const Mesh& a, const Mesh& b) {
    EXPECT_EQ(a.points, b.points);
    EXPECT_EQ(a.node_ids, b.node_ids);
    for (const CellBlock& block : a.blocks()) {
        EXPECT_EQ(block.connectivity, b.block(block.type).connectivity);
        EXPECT_EQ(block.ids, b.block(block.type).ids);
    }
}

/// A box with a border inside, its top named, and a beam.
Mesh box_with_groups() {
    Mesh mesh = checks::grid(5, 4, 4);
    const FamilyIndex left = checks::family_of(mesh, "LEFT", GroupKind::element),
                      top = checks::family_of(mesh, "TOP", GroupKind::node);
    CellBlock& tetras = mesh.block(CellType::tetra);
    for (Index c = 0; c < tetras.size(); ++c)
        if (mesh.points[tetras.nodes(c)[0]].y() < 2) tetras.families[c] = left;
    for (Index n = 0; n < mesh.node_count(); ++n)
        if (mesh.points[n].z() == 4) mesh.node_families[n] = top;
    return mesh;
}

const Plane oblique({2.3, 2, 2}, {1, 0.3, 0.2});

TEST(CancelTest, OperatorsEndAtEveryCheckPoint) {
    const Mesh mesh = box_with_groups(), untouched = mesh, curved = checks::second_order(checks::grid(3, 3, 3));
    const Cylinder hole({2.4, 2.1, 0}, {0.1, 0, 1}, 1), fine({2.4, 2.1, 0}, {0, 0, 1}, 0.6);
    const Torus torus({2.4, 2.1, 2}, {0, 0, 1}, 1.2, 0.5);
    const Disk disk({2.3, 2, 2}, 1);
    const Tool *hole_tool = &hole, *fine_tool = &fine;
    const std::vector<std::pair<const char*, std::function<Mesh()>>> operations = {
        {"crack", [&] { return crack(mesh, oblique).mesh; }},
        {"crack of second-order elements",
         [&] {
             return crack(curved, Plane({1.4, 1, 1}, {1, 0.1, 0.2})).mesh;
         }},
        {"crack, deform",
         [&] {
             CrackOptions o;
             o.method = Method::deform;
             return crack(mesh, oblique, o).mesh;
         }},
        {"crack within a disk",
         [&] {
             CrackOptions o;
             o.within = &disk;
             return crack(mesh, oblique, o).mesh;
         }},
        {"crack along a torus", [&] { return crack(mesh, torus).mesh; }},
        {"drill",
         [&] {
             return drill(mesh, {&hole_tool, 1}).mesh;
         }},
        {"drill, refined first",
         [&] {
             return drill(mesh, {&fine_tool, 1}).mesh;
         }},
        {"cut", [&] { return cut(mesh, oblique, 0.7).mesh; }},
        {"refine",
         [&] {
             RefineOptions o;
             o.size = 0.6;
             return refine(mesh, distance_to(std::vector<const Tool*>{&fine}), o).mesh;
         }},
    };
    for (const auto& [name, run] : operations) {
        SCOPED_TRACE(name);
        const Mesh before = run();
        cancel_everywhere([&run = run] { run(); });
        expect_same(run(), before);
        expect_same(mesh, untouched);
    }
}

TEST(CancelTest, ASessionGoesOnAsIfNothingHadBeen) {
    const auto mesh = std::make_shared<const Mesh>(box_with_groups());
    cancel_everywhere([&] { Scalpel scalpel(mesh); });
    const Scalpel scalpel(mesh);
    const Mesh before = crack(scalpel.mesh(), oblique, {}, scalpel.prepared()).mesh;
    cancel_everywhere([&] { crack(scalpel.mesh(), oblique, {}, scalpel.prepared()); });
    expect_same(crack(scalpel.mesh(), oblique, {}, scalpel.prepared()).mesh, before);
}

TEST(CancelTest, ADeckIsCarriedOverOrNot) {
    const fs::path path =
        fs::path(testing::TempDir()) / ("femscalpel_cancel_deck_" + std::to_string(::getpid()) + ".inp");
    {
        write(box_with_groups(), path);
        std::ofstream out(path, std::ios::app);
        out << "*BOUNDARY\nTOP, 1, 3\n*STEP\n*STATIC\n*CLOAD\nTOP, 3, 1.\n*END STEP\n";
    }
    const Mesh mesh = read(path);
    fs::remove(path);
    const Result before = crack(mesh, oblique);
    ASSERT_TRUE(before.mesh.companion);
    cancel_everywhere([&] { crack(mesh, oblique); });
    expect_same(crack(mesh, oblique).mesh, before.mesh);
}

TEST(CancelTest, ReadingEndsAndWritingLeavesTheOldFile) {
    const fs::path folder = fs::path(testing::TempDir()) / ("femscalpel_cancel_files_" + std::to_string(::getpid()));
    fs::remove_all(folder);
    fs::create_directories(folder);
    const Mesh mesh = box_with_groups();
    for (const char* type : {".med", ".inp", ".inp.gz", ".vtu", ".msh", ".unv", ".bdf"}) {
        SCOPED_TRACE(type);
        const fs::path path = folder / (std::string("mesh") + type);
        std::ofstream(path) << "old";
        cancel_everywhere([&] { write(mesh, folder / (std::string("other") + type)); },
                          [&] { fs::remove(folder / (std::string("other") + type)); });
        fs::remove(folder / (std::string("other") + type));
        const long count = run_until(never, [&] { write(mesh, folder / "count" += type); });
        fs::remove(folder / "count" += type);
        for (long k = 1; k <= count; ++k) {
            EXPECT_THROW(run_until(k, [&] { write(mesh, path); }), Cancelled);
            std::ifstream in(path);
            EXPECT_EQ(std::string(std::istreambuf_iterator<char>(in), {}), "old");
            EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator{}), 1)
                << "a file is left over";
        }
        write(mesh, path);
        cancel_everywhere([&] { read(path); });
        expect_same(read(path), mesh);
        fs::remove(path);
    }
    fs::remove_all(folder);
}

TEST(CancelTest, VirtualBoundariesEnd) {
    const Mesh mesh = checks::grid(12, 12, 12);
    cancel_everywhere([&] { const VirtualBoundaryFinder finder(mesh); });
}

TEST(CancelTest, AnotherThreadEndsALargeOperation) {
    const Mesh mesh = read(fs::path(FEMSCALPEL_TEST_MESHES) / "two_boxes_39k.inp");
    const CancelToken token;
    std::thread other([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(30));
        token.cancel();
    });
    const auto work = [&] {
        const CancelScope scope(token);
        for (;;) crack(mesh, Plane({7.3, 5, 5}, {0.9, 0.3, 0.2}));
    };
    EXPECT_THROW(work(), Cancelled);
    other.join();
    EXPECT_NO_THROW(crack(mesh, Plane({7.3, 5, 5}, {0.9, 0.3, 0.2}))) << "outside of the scope nothing is cancelled";
}

TEST(CancelTest, ThreadsObeyWhatTheirMakerDoes) {
    const CancelToken outer, inner;
    const CancelScope outer_scope(outer);
    std::future<int> work;
    {
        const CancelScope inner_scope(inner);
        work = async_obeying(std::launch::async, [] {
            for (;;) {
                check_cancelled();
                std::this_thread::yield();
            }
            return 0;
        });
        EXPECT_NO_THROW(check_cancelled());
        outer.cancel();
        EXPECT_THROW(check_cancelled(), Cancelled);
    }
    EXPECT_THROW(work.get(), Cancelled);
}

TEST(CancelTest, WaitingForAThreadEnds) {
    std::promise<int> never_kept;
    std::future<int> result = never_kept.get_future();
    long asked = 0;
    const CancelScope scope(CancelToken(), [&] { return ++asked == 2; });
    EXPECT_THROW(await(result), Cancelled);
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
