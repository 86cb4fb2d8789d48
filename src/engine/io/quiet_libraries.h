// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdio>

namespace femscalpel {

/// While it lives, what C code prints on the C library's `stderr` in the thread that made it is dropped, and HDF5
/// keeps its error stack to itself. MED-fichier prints what it finds in damaged files from some thousand places, and
/// has no switch for that; what is wrong is in our errors.
///
/// Nothing but the pointer `stderr` is exchanged, for a stream that passes on what any other thread prints to the one
/// that was there: file descriptor 2, Python's sys.stderr and std::cerr are not touched, nor are programs started
/// meanwhile, and nothing that other threads print is lost. The stream is never closed, so that a thread that took it
/// just before the end can still use it. Several can live at once; all but the outermost of all do nothing to the
/// pointer. Where the C library does not let us exchange it (other than GNU's), MED-fichier prints.
class QuietLibraries {
public:
    QuietLibraries();
    ~QuietLibraries();
    QuietLibraries(const QuietLibraries&) = delete;
    QuietLibraries& operator=(const QuietLibraries&) = delete;
};

}  // namespace femscalpel
