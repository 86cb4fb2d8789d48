// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Fills the cavity that comes through a socket by Netgen's library, and sends the tetrahedra back; see
// cutting/fill_protocol.h. Netgen (J. Schoeberl, "NETGEN: An advancing front 2D/3D-mesh generator based on abstract
// rules", Comput. Visual. Sci. 1, 1997) is under the LGPL.
#include <dlfcn.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <string>
#include <vector>

#include "cutting/fill_protocol.h"
#include "helper_process.h"

namespace nglib {
#include <netgen/nglib.h>
}

namespace {

using femscalpel::fill_protocol::Answer;
using femscalpel::fill_protocol::Request;
using Point = std::array<double, 3>;

struct Cavity {
    Request request;
    std::vector<Point> points;
    std::vector<std::array<std::int32_t, 3>> triangles;
};

struct Filling {
    std::vector<Point> points;  // new ones
    std::vector<std::array<std::int32_t, 4>> tetras;
    double worst = -2;
    std::string failure = "no attempt";
};

void receive(void* data, std::size_t bytes) {
    auto* at = static_cast<char*>(data);
    while (bytes > 0) {
        const ssize_t got = read(femscalpel::helper_socket, at, bytes);
        if (got <= 0) _exit(2);
        at += got;
        bytes -= static_cast<std::size_t>(got);
    }
}

void send_back(const void* data, std::size_t bytes) {
    const auto* at = static_cast<const char*>(data);
    while (bytes > 0) {
        const ssize_t sent = send(femscalpel::helper_socket, at, bytes, MSG_NOSIGNAL);
        if (sent <= 0) _exit(2);
        at += sent;
        bytes -= static_cast<std::size_t>(sent);
    }
}

Cavity receive_cavity() {
    Cavity cavity;
    receive(&cavity.request, sizeof(Request));
    cavity.points.resize(cavity.request.points);
    cavity.triangles.resize(cavity.request.triangles);
    receive(cavity.points.data(), cavity.points.size() * sizeof(Point));
    receive(cavity.triangles.data(), cavity.triangles.size() * sizeof(std::array<std::int32_t, 3>));
    return cavity;
}

double mean_ratio(const Point& a, const Point& b, const Point& c, const Point& d) {
    const auto edge = [](const Point& p, const Point& q) { return Point{q[0] - p[0], q[1] - p[1], q[2] - p[2]}; };
    const auto square = [](const Point& e) { return e[0] * e[0] + e[1] * e[1] + e[2] * e[2]; };
    const Point u = edge(a, b), v = edge(a, c), w = edge(a, d);
    const double six =
        u[0] * (v[1] * w[2] - v[2] * w[1]) + u[1] * (v[2] * w[0] - v[0] * w[2]) + u[2] * (v[0] * w[1] - v[1] * w[0]);
    const double squares =
        square(u) + square(v) + square(w) + square(edge(b, c)) + square(edge(b, d)) + square(edge(c, d));
    return std::copysign(12 * std::cbrt(six * six / 4), six) / squares;
}

/// Netgen's mesh of a cavity; its numbers count from 1.
class NetgenMesh {
public:
    explicit NetgenMesh(const Cavity& cavity) : mesh_(nglib::Ng_NewMesh()) {
        for (Point p : cavity.points) nglib::Ng_AddPoint(mesh_, p.data());
        for (const auto& t : cavity.triangles) {
            int nodes[3] = {t[0] + 1, t[1] + 1, t[2] + 1};
            nglib::Ng_AddSurfaceElement(mesh_, nglib::NG_TRIG, nodes);
        }
    }
    ~NetgenMesh() { nglib::Ng_DeleteMesh(mesh_); }
    NetgenMesh(const NetgenMesh&) = delete;
    NetgenMesh& operator=(const NetgenMesh&) = delete;

    void restrict_edges(double length) { nglib::Ng_RestrictMeshSizeGlobal(mesh_, length); }

    void generate(nglib::Ng_Meshing_Parameters& parameters) {
        const nglib::Ng_Result result = nglib::Ng_GenerateVolumeMesh(mesh_, &parameters);
        if (result != nglib::NG_OK) throw std::string("result " + std::to_string(result));
    }

    Filling filling(const Cavity& cavity) const {
        Filling filling;
        std::vector<Point> all = cavity.points;
        const int given = static_cast<int>(all.size()), points = nglib::Ng_GetNP(mesh_);
        for (int k = given; k < points; ++k) {
            nglib::Ng_GetPoint(mesh_, k + 1, all.emplace_back().data());
            filling.points.push_back(all.back());
        }
        filling.worst = 1;
        for (int k = 0; k < nglib::Ng_GetNE(mesh_); ++k) {
            int n[10];
            nglib::Ng_GetVolumeElement(mesh_, k + 1, n);
            // Netgen's tetrahedra look at their fourth node the other way round.
            const std::array<std::int32_t, 4> tetra = {n[0] - 1, n[2] - 1, n[1] - 1, n[3] - 1};
            filling.tetras.push_back(tetra);
            const auto& [a, b, c, d] = tetra;
            filling.worst = std::fmin(filling.worst, mean_ratio(all[a], all[b], all[c], all[d]));
        }
        if (filling.tetras.empty()) throw std::string("no tetrahedra");
        return filling;
    }

private:
    nglib::Ng_Mesh* mesh_;
};

/// How one attempt differs from the next.
struct Attempt {
    double grading;  // factor on what is asked for
    int steps;       // of optimization
};

Filling fill(const Cavity& cavity, const Attempt& attempt) {
    Filling failed;
    try {
        nglib::Ng_Meshing_Parameters parameters;
        parameters.maxh = cavity.request.max_edge;
        parameters.grading = std::fmin(cavity.request.grading * attempt.grading, 1);
        parameters.optsteps_3d = attempt.steps;
        NetgenMesh mesh(cavity);
        mesh.restrict_edges(cavity.request.max_edge);
        mesh.generate(parameters);
        return mesh.filling(cavity);
    } catch (const std::string& text) {
        failed.failure = text;
    } catch (const std::exception& e) {
        failed.failure = e.what();
    } catch (...) {
        failed.failure = "an exception";
    }
    return failed;
}

/// The best of some attempts, the first that is good enough; of large cavities one that is done must do. Where elements
/// twice as coarse come out as poor, the cavity's faces make them so, and nothing else is tried.
Filling best_filling(const Cavity& cavity) {
    constexpr double same = 0.02;
    constexpr std::size_t patience = 30000;  // elements made so far: a measure of time that is the same everywhere
    std::size_t made = 0;
    Filling best;
    for (const Attempt& attempt : {Attempt{1, 3}, Attempt{2, 5}, Attempt{1, 8}, Attempt{0.5, 5}, Attempt{0.25, 8}}) {
        Filling next = fill(cavity, attempt);
        made += next.tetras.size();
        const bool by_faces = attempt.grading == 2 && std::abs(next.worst - best.worst) <= same * best.worst;
        if (next.worst > best.worst || best.tetras.empty()) best = std::move(next);
        if (best.worst >= cavity.request.enough || by_faces) break;
        if (best.worst > 0.2 && made > patience) break;
    }
    return best;
}

/// A function of Netgen's, by its name in the library, or null where this Netgen has none.
template <class F>
F* netgen_function(const char* name) {
    return reinterpret_cast<F*>(dlsym(RTLD_DEFAULT, name));
}

/// Newer Netgens fill in four threads that wait for each other in loops, which takes many times as long where other
/// processes want the processor, too; they start none where a pool of threads is there. So there is one, of one thread.
/// The functions are looked for by name, as Netgen 6.2.19 has neither them nor their header.
void work_in_one_thread() {
    if (auto* start = netgen_function<int(int)>("_ZN6ngcore16EnterTaskManagerEi")) {
        start(1);
        return;
    }
    auto* set_threads = netgen_function<void(int)>("_ZN6ngcore11TaskManager13SetNumThreadsEi");
    auto* start = netgen_function<int()>("_ZN6ngcore16EnterTaskManagerEv");
    if (!set_threads || !start) return;
    set_threads(1);
    start();
}

}  // namespace

int main() {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    const Cavity cavity = receive_cavity();
    work_in_one_thread();
    nglib::Ng_Init();
    const Filling filling = best_filling(cavity);
    Answer answer{};
    if (filling.tetras.empty()) {
        answer.text = static_cast<std::int32_t>(filling.failure.size());
        send_back(&answer, sizeof answer);
        send_back(filling.failure.data(), filling.failure.size());
    } else {
        answer.points = static_cast<std::int32_t>(filling.points.size());
        answer.tetras = static_cast<std::int32_t>(filling.tetras.size());
        send_back(&answer, sizeof answer);
        send_back(filling.points.data(), filling.points.size() * sizeof(Point));
        send_back(filling.tetras.data(), filling.tetras.size() * sizeof(std::array<std::int32_t, 4>));
    }
    // What static destructors of the libraries do is of no interest.
    _exit(0);
}
