#include "mms/storage/compression.hpp"

#include <bzlib.h>
#include <lz4frame.h>
#include <zstd.h>

#include <algorithm>
#include <fstream>
#include <memory>
#include <vector>

#include "mms/core/error.hpp"
#include "mms/io/text/atomic_file.hpp"

namespace mms {
namespace fs = std::filesystem;
namespace {

/// One step of a decoder: fills a part of `out`.
struct Step {
  std::size_t produced = 0;
  bool progress = false;  ///< produced or consumed something
  bool finished = false;
  bool damaged = false;
};

class Bz2Decoder {
 public:
  explicit Bz2Decoder(std::string_view bytes) {
    stream_.next_in = const_cast<char*>(bytes.data());  // only read
    stream_.avail_in = static_cast<unsigned>(bytes.size());
    if (BZ2_bzDecompressInit(&stream_, 0, 0) != BZ_OK) throw std::bad_alloc();
  }
  ~Bz2Decoder() { BZ2_bzDecompressEnd(&stream_); }
  Bz2Decoder(const Bz2Decoder&) = delete;
  Bz2Decoder& operator=(const Bz2Decoder&) = delete;

  Step step(char* out, std::size_t size) {
    stream_.next_out = out;
    stream_.avail_out = static_cast<unsigned>(size);
    const unsigned before = stream_.avail_in;
    const int result = BZ2_bzDecompress(&stream_);
    const std::size_t produced = size - stream_.avail_out;
    return {produced, produced > 0 || stream_.avail_in < before, result == BZ_STREAM_END,
            result != BZ_OK && result != BZ_STREAM_END};
  }

 private:
  bz_stream stream_{};
};

class Lz4Decoder {
 public:
  explicit Lz4Decoder(std::string_view bytes) : left_(bytes) {
    if (LZ4F_isError(LZ4F_createDecompressionContext(&context_, LZ4F_VERSION)) != 0) {
      throw std::bad_alloc();
    }
  }
  ~Lz4Decoder() { LZ4F_freeDecompressionContext(context_); }
  Lz4Decoder(const Lz4Decoder&) = delete;
  Lz4Decoder& operator=(const Lz4Decoder&) = delete;

  Step step(char* out, std::size_t size) {
    std::size_t produced = size;
    std::size_t used = left_.size();
    const std::size_t hint =
        LZ4F_decompress(context_, out, &produced, left_.data(), &used, nullptr);
    if (LZ4F_isError(hint) != 0) return {.damaged = true};
    left_.remove_prefix(used);
    return {produced, produced > 0 || used > 0, hint == 0 && left_.empty(), false};
  }

 private:
  LZ4F_dctx* context_ = nullptr;
  std::string_view left_;
};

class ZstdDecoder {
 public:
  explicit ZstdDecoder(std::string_view bytes) : in_{bytes.data(), bytes.size(), 0} {
    if (context_ == nullptr) throw std::bad_alloc();
    // A frame may ask for a window of gigabytes.
    constexpr int kWindowLog = 27;  // 128 MiB, the default of zstd
    ZSTD_DCtx_setParameter(context_.get(), ZSTD_d_windowLogMax, kWindowLog);
  }

  Step step(char* out, std::size_t size) {
    ZSTD_outBuffer block{out, size, 0};
    const std::size_t before = in_.pos;
    const std::size_t hint = ZSTD_decompressStream(context_.get(), &block, &in_);
    const bool damaged = ZSTD_isError(hint) != 0U;
    return {block.pos, block.pos > 0 || in_.pos > before,
            !damaged && hint == 0 && in_.pos == in_.size, damaged};
  }

  /// Continues with the next part of the input.
  void set_input(std::string_view bytes) { in_ = {bytes.data(), bytes.size(), 0}; }
  bool input_used() const { return in_.pos == in_.size; }

 private:
  struct Free {
    void operator()(ZSTD_DCtx* context) const { ZSTD_freeDCtx(context); }
  };
  std::unique_ptr<ZSTD_DCtx, Free> context_{ZSTD_createDCtx()};
  ZSTD_inBuffer in_;
};

struct Decompressed {
  std::string bytes;
  std::string fault;  ///< empty if complete
};

template <class Decoder>
Decompressed run(std::string_view bytes, std::size_t limit) {
  // Customary data are compressed by less than 4.
  const std::size_t first = 4 * bytes.size() + (std::size_t{64} << 10U);
  Decoder decoder(bytes);
  Decompressed result;
  while (true) {
    const std::size_t done = result.bytes.size();
    // One byte beyond the limit: a decoder without space does not recognize its end.
    const std::size_t space = std::min(limit + 1 - done, std::max(first, done));
    result.bytes.resize(done + space);
    const Step step = decoder.step(result.bytes.data() + done, space);
    result.bytes.resize(done + step.produced);
    if (result.bytes.size() > limit) {
      result.bytes.resize(limit);
      result.fault = "is larger than " + std::to_string(limit) + " bytes when decompressed";
    } else if (step.damaged) {
      result.fault = "is damaged and cannot be decompressed";
    } else if (!step.finished && !step.progress) {
      result.fault = "is compressed data that ends too early";
    } else if (!step.finished) {
      continue;
    }
    return result;
  }
}

Decompressed decompressed(std::string_view bytes, Compression compression, std::size_t limit) {
  switch (compression) {
    case Compression::kBz2:
      return run<Bz2Decoder>(bytes, limit);
    case Compression::kLz4:
      return run<Lz4Decoder>(bytes, limit);
    case Compression::kZstd:
      return run<ZstdDecoder>(bytes, limit);
    default:
      return {std::string(bytes.substr(0, limit)),
              bytes.size() > limit ? "is larger than " + std::to_string(limit) + " bytes" : ""};
  }
}

}  // namespace

Compression compression_of(std::string_view name, const std::string& where) {
  if (name.empty() || name == "none") return Compression::kNone;
  if (name == "bz2") return Compression::kBz2;
  if (name == "lz4") return Compression::kLz4;
  if (name == "zstd") return Compression::kZstd;
  throw DataError(where, "has the compression '" + std::string(name.substr(0, 20)) +
                             "', expected none, bz2, lz4 or zstd");
}

std::string decompress(std::string_view bytes, Compression compression, std::size_t limit,
                       const std::string& where) {
  Decompressed result = decompressed(bytes, compression, limit);
  if (!result.fault.empty()) throw DataError(where, result.fault);
  return std::move(result.bytes);
}

std::string decompress_start(std::string_view bytes, Compression compression, std::size_t limit) {
  return decompressed(bytes, compression, limit).bytes;
}

std::string compress_zstd(std::string_view bytes) {
  constexpr int kLevel = 1;
  std::string result(ZSTD_compressBound(bytes.size()), '\0');
  struct Free {
    void operator()(ZSTD_CCtx* context) const { ZSTD_freeCCtx(context); }
  };
  const std::unique_ptr<ZSTD_CCtx, Free> context(ZSTD_createCCtx());
  if (!context) throw std::bad_alloc();
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_compressionLevel, kLevel);
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_checksumFlag, 1);
  const std::size_t size =
      ZSTD_compress2(context.get(), result.data(), result.size(), bytes.data(), bytes.size());
  if (ZSTD_isError(size) != 0U) throw std::bad_alloc();  // no other fault is possible here
  result.resize(size);
  return result;
}

bool is_zstd(std::string_view bytes) {
  return bytes.starts_with("\x28\xB5\x2F\xFD");
}

namespace {

/// [B]: size up to which a file may be decompressed in any case.
constexpr std::uint64_t kMaxSurely = std::uint64_t{512} << 20U;
/// Largest ratio of the sizes of larger files; recordings are compressed by 2 to 20.
constexpr std::uint64_t kMaxRatio = 200;

}  // namespace

void decompress_zstd_file(const fs::path& from, const fs::path& to) {
  std::error_code error;
  const fs::file_status status = fs::status(from, error);
  if (!fs::exists(status)) throw FileError(from.string(), "no such file");
  if (!fs::is_regular_file(status)) throw FileError(from.string(), "is not a regular file");
  std::uint64_t left = kMaxSurely + kMaxRatio * fs::file_size(from, error);
  std::ifstream in(from, std::ios::binary);
  if (!in || error) throw FileError(from.string(), "cannot be read");
  AtomicFile file(to);
  ZstdDecoder decoder({});
  std::vector<char> input(ZSTD_DStreamInSize());
  std::vector<char> output(ZSTD_DStreamOutSize());
  Step step;
  bool begins = true;
  while (in.read(input.data(), static_cast<std::streamsize>(input.size())) || in.gcount() > 0) {
    const std::string_view part(input.data(), static_cast<std::size_t>(in.gcount()));
    if (begins && !is_zstd(part)) throw DataError(from.string(), "is not compressed by zstd");
    begins = false;
    decoder.set_input(part);
    do {
      step = decoder.step(output.data(), output.size());
      if (step.produced > left) {
        throw DataError(
            from.string(),
            "is larger than " + std::to_string(kMaxRatio) + " times its size when decompressed",
            "if that is right, decompress it with zstd and open the result");
      }
      left -= step.produced;
      file.write({output.data(), step.produced});
    } while (!step.damaged && (!decoder.input_used() || step.produced == output.size()));
    if (step.damaged) break;
  }
  file.commit();
}

}  // namespace mms
