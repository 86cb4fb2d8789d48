// SPDX-License-Identifier: LGPL-2.1-or-later
#include "io/quiet_libraries.h"

#include <hdf5.h>
#include <sys/types.h>

#include <mutex>

namespace femscalpel {
namespace {

thread_local int quiet_here = 0;
std::mutex quiet_mutex;
int quiet_anywhere = 0;

/// MED-fichier turns HDF5's messages off, too, with an older call that leaves HDF5 confused when it closes at the end
/// of the program; hence at the end as well.
void quieten_hdf5() { H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); }

#ifdef __GLIBC__

FILE* stderr_before = nullptr;  // who reads it in pass_on() came by way of the filter

ssize_t pass_on(void*, const char* text, size_t size) {
    if (quiet_here == 0) std::fwrite(text, 1, size, __atomic_load_n(&stderr_before, __ATOMIC_SEQ_CST));
    return static_cast<ssize_t>(size);
}

/// Null if there is no memory for it.
FILE* make_filter() {
    FILE* filter = fopencookie(nullptr, "w", {nullptr, pass_on, nullptr, nullptr});
    if (filter) std::setvbuf(filter, nullptr, _IONBF, 0);
    return filter;
}

void exchange_stderr(bool quiet) {
    static FILE* const filter = make_filter();
    if (!filter) return;
    if (quiet) {
        __atomic_store_n(&stderr_before, stderr, __ATOMIC_SEQ_CST);
        __atomic_store_n(&stderr, filter, __ATOMIC_SEQ_CST);
    } else if (stderr == filter) {  // else someone has set another meanwhile
        __atomic_store_n(&stderr, stderr_before, __ATOMIC_SEQ_CST);
    }
}

#else

void exchange_stderr(bool) {}

#endif

}  // namespace

QuietLibraries::QuietLibraries() {
    ++quiet_here;
    const std::lock_guard lock(quiet_mutex);
    if (quiet_anywhere++ == 0) exchange_stderr(true);
    quieten_hdf5();
}

QuietLibraries::~QuietLibraries() {
    quieten_hdf5();
    const std::lock_guard lock(quiet_mutex);
    if (--quiet_anywhere == 0) exchange_stderr(false);
    --quiet_here;
}

}  // namespace femscalpel
