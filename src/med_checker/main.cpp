// SPDX-License-Identifier: LGPL-2.1-or-later
//
// femscalpel-check-med FILE: looks at an old HDF5 file, and says through the socket it was started with how far it is
// sound (io/med_structure.h). HDF5 may crash or hang on the way; who started it takes that for damage.
#include <hdf5.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <csignal>
#include <exception>

#include "helper_process.h"
#include "io/med_structure.h"

namespace {

using namespace femscalpel;

void say(char word) {
    if (send(helper_socket, &word, 1, MSG_NOSIGNAL) != 1) _exit(2);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) return 2;
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    prctl(PR_SET_DUMPABLE, 0);  // a crash is an answer, nothing to report
    say(check_med_protocol::begun);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    try {
        if (!is_sound_structure(argv[1], MedPart::mesh, MedLook::everything)) _exit(1);
        say(check_med_protocol::sound_mesh);
        if (!is_sound_structure(argv[1], MedPart::fields, MedLook::everything)) _exit(1);
        say(check_med_protocol::sound_fields);
    } catch (const std::exception&) {  // no memory for what a damaged file asks for
        _exit(1);
    }
    // What HDF5 does at the end of a process is of no interest.
    _exit(0);
}
