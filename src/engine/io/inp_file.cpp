// SPDX-License-Identifier: LGPL-2.1-or-later
#include "io/inp_file.h"

#include <zlib.h>

#include <algorithm>
#include <fstream>
#include <memory>
#include <vector>

#include "cancel.h"
#include "error.h"
#include "io/atomic_file.h"
#include "utf8.h"

namespace femscalpel {
namespace {

namespace fs = std::filesystem;

std::string unzip(const std::string& packed, const std::string& shown) {
    z_stream stream{};
    if (inflateInit2(&stream, 15 + 16) != Z_OK) throw ReadError(shown + ": cannot start unpacking gzip");
    const std::unique_ptr<z_stream, int (*)(z_streamp)> end(&stream, inflateEnd);
    std::string out;
    std::vector<char> buffer(1 << 18);
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
    std::size_t left = packed.size();
    int status = Z_OK;
    while (true) {
        if (stream.avail_in == 0 && left > 0) {
            stream.avail_in = static_cast<uInt>(std::min<std::size_t>(left, 1u << 30));
            left -= stream.avail_in;
        }
        stream.next_out = reinterpret_cast<Bytef*>(buffer.data());
        stream.avail_out = static_cast<uInt>(buffer.size());
        check_cancelled();
        status = inflate(&stream, Z_NO_FLUSH);
        if (status != Z_OK && status != Z_STREAM_END) break;
        out.append(buffer.data(), buffer.size() - stream.avail_out);
        if (status == Z_STREAM_END) {
            if (stream.avail_in == 0 && left == 0) break;
            inflateReset(&stream);  // gzip files may be several in a row
        }
    }
    if (status != Z_STREAM_END) throw ReadError(shown + ": the gzip'd file is truncated or damaged");
    return out;
}

}  // namespace

bool is_packed(const fs::path& path) {
    const std::string extension = path.extension().string();
    return extension.size() == 3 && (extension[1] == 'g' || extension[1] == 'G') &&
           (extension[2] == 'z' || extension[2] == 'Z');
}

std::string load_bytes(const fs::path& path) {
    const std::string name = shown_path(path);
    std::error_code error;
    if (!fs::exists(path, error)) throw ReadError(name + ": no such file");
    if (!fs::is_regular_file(path, error)) throw ReadError(name + ": not a regular file");
    std::ifstream in(path, std::ios::binary);
    const auto size = fs::file_size(path, error);
    if (!in || error) throw ReadError(name + ": cannot be opened for reading");
    std::string text(size, '\0');
    constexpr std::size_t piece = 1 << 23;
    for (std::size_t at = 0; at < size; at += piece) {
        check_cancelled();
        const auto wanted = static_cast<std::streamsize>(std::min<std::size_t>(piece, size - at));
        in.read(text.data() + at, wanted);
        if (in.gcount() != wanted) throw ReadError(name + ": reading failed");
    }
    if (text.starts_with("\x1f\x8b")) return unzip(text, name);
    return text;
}

void save_text(const fs::path& path, const std::string& text) {
    AtomicFile file(path);
    if (is_packed(path)) {
        std::unique_ptr<gzFile_s, int (*)(gzFile)> out(gzopen(file.temporary().c_str(), "wb6"), gzclose);
        bool good = out != nullptr;
        for (std::size_t at = 0; good && at < text.size();) {
            check_cancelled();
            const auto part = static_cast<unsigned>(std::min<std::size_t>(text.size() - at, 1u << 18));
            good = gzwrite(out.get(), text.data() + at, part) == static_cast<int>(part);
            at += part;
        }
        if (out) good = gzclose(out.release()) == Z_OK && good;
        if (!good) throw WriteError(shown_path(path) + ": writing failed (disk full?)");
    } else {
        std::ofstream out(file.temporary(), std::ios::binary);
        write_obeying(out, text);
        out.close();
        if (!out) throw WriteError(shown_path(path) + ": writing failed (disk full?)");
    }
    file.commit();
}

}  // namespace femscalpel
