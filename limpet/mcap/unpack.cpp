// SPDX-License-Identifier: Apache-2.0
#include "limpet/mcap/unpack.hpp"

#include <lz4frame.h>
#include <zstd.h>

#include <algorithm>
#include <new>

#include "limpet/core/errors.hpp"

namespace limpet::mcap {
namespace {

constexpr std::string_view kZstdMagic("\x28\xB5\x2F\xFD", 4);
constexpr std::string_view kLz4Magic("\x04\x22\x4D\x18", 4);

/// How far a packed text has been read.
struct Progress {
    std::size_t at = 0;
    bool whole = false;   ///< a frame has ended there
    bool broken = false;  ///< and goes on with what is none
};

/// A context for frames of LZ4, which may stand one behind the other.
class Lz4 {
public:
    Lz4() {
        if (LZ4F_isError(LZ4F_createDecompressionContext(&context_, LZ4F_VERSION)) != 0) {
            throw std::bad_alloc();
        }
    }
    ~Lz4() { LZ4F_freeDecompressionContext(context_); }
    Lz4(const Lz4&) = delete;
    Lz4& operator=(const Lz4&) = delete;

    /// Goes on for as long as there is something to read and space for it.
    /// @return bytes written
    std::size_t unpack(std::string_view packed, Progress& progress, char* out, std::size_t space) {
        std::size_t written = 0;
        while (true) {
            std::size_t took = packed.size() - progress.at;
            std::size_t gave = space - written;
            const std::size_t hint = LZ4F_decompress(context_, out + written, &gave,
                                                     packed.data() + progress.at, &took, nullptr);
            if (LZ4F_isError(hint) != 0) {
                LZ4F_resetDecompressionContext(context_);
                progress.broken = true;
                return written;
            }
            progress.at += took;
            written += gave;
            progress.whole = hint == 0;
            if ((took == 0 && gave == 0) || progress.at == packed.size() || written == space) {
                return written;
            }
        }
    }
    void reset() { LZ4F_resetDecompressionContext(context_); }

private:
    LZ4F_dctx* context_ = nullptr;
};

class Zstd {
public:
    Zstd() : context_(ZSTD_createDCtx()) {
        if (context_ == nullptr) {
            throw std::bad_alloc();
        }
    }
    ~Zstd() { ZSTD_freeDCtx(context_); }
    Zstd(const Zstd&) = delete;
    Zstd& operator=(const Zstd&) = delete;

    [[nodiscard]] ZSTD_DCtx* get() const { return context_; }

    /// As Lz4::unpack.
    std::size_t unpack(std::string_view packed, Progress& progress, char* out, std::size_t space) {
        ZSTD_inBuffer in{packed.data(), packed.size(), progress.at};
        ZSTD_outBuffer to{out, space, 0};
        while (true) {
            const std::size_t before = in.pos + to.pos;
            const std::size_t hint = ZSTD_decompressStream(context_, &to, &in);
            if (ZSTD_isError(hint) != 0U) {
                progress.broken = true;
                return to.pos;
            }
            progress.at = in.pos;
            progress.whole = hint == 0;
            if (in.pos + to.pos == before || in.pos == in.size || to.pos == to.size) {
                return to.pos;
            }
        }
    }

private:
    ZSTD_DCtx* context_;
};

/// Piece by piece: how large it becomes is known at its end alone.
template <class Format>
std::string unpacked_by(std::string_view file, std::uint64_t most_bytes) {
    constexpr std::uint64_t kPiece_bytes = 1 << 20;
    Format format;
    std::string out;
    Progress progress;
    for (std::size_t gave = 1; gave > 0 && !progress.broken && out.size() <= most_bytes;) {
        const std::size_t before = out.size();
        const auto space =
            static_cast<std::size_t>(std::min(kPiece_bytes, most_bytes + 1 - before));
        out.resize(before + space);
        gave = format.unpack(file, progress, out.data() + before, space);
        out.resize(before + gave);
    }
    return out;
}

}  // namespace

struct Unpacker::Contexts {
    Zstd zstd;
    Lz4 lz4;
};

Unpacker::Unpacker() : contexts_(std::make_unique<Contexts>()) {}
Unpacker::~Unpacker() = default;

bool Unpacker::knows(std::string_view compression) {
    return compression == "zstd" || compression == "lz4";
}

void Unpacker::unpack(std::string_view compression, ByteView stored, Bytes& out) {
    if (compression == "zstd") {
        const std::size_t size = ZSTD_decompressDCtx(contexts_->zstd.get(), out.data(), out.size(),
                                                     stored.data(), stored.size());
        if (ZSTD_isError(size) != 0U || size != out.size()) {
            throw Malformed("chunk that does not unpack by " + std::string(compression));
        }
        return;
    }
    require(compression == "lz4", "a compression that is known");
    Lz4& lz4 = contexts_->lz4;
    lz4.reset();
    Progress progress;
    const std::size_t size =
        lz4.unpack(Cursor::text(stored), progress, reinterpret_cast<char*>(out.data()), out.size());
    std::size_t more = 0;
    if (!progress.whole && !progress.broken) {  // with the buffer full, its end is not read yet
        char beyond = 0;
        more = lz4.unpack(Cursor::text(stored), progress, &beyond, 1);
    }
    if (size != out.size() || more != 0 || !progress.whole || progress.broken ||
        progress.at != stored.size()) {
        throw Malformed("chunk that does not unpack by " + std::string(compression));
    }
}

bool is_packed(std::string_view file) {
    return file.starts_with(kZstdMagic) || file.starts_with(kLz4Magic);
}

std::string unpacked_file(std::string_view file, std::uint64_t most_bytes) {
    return file.starts_with(kZstdMagic) ? unpacked_by<Zstd>(file, most_bytes)
                                        : unpacked_by<Lz4>(file, most_bytes);
}

}  // namespace limpet::mcap
