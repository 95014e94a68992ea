// Unpacks the chunks of an MCAP file.
#include "ident/io/mcap/decompress.h"

#include <fmt/format.h>
#include <lz4frame.h>
#include <zstd.h>

#include <algorithm>
#include <memory>

namespace ident::mcap {

namespace {

/// Chunks of a bag have about 1 MB; of zeros zstd makes some thousandth, plus a header.
std::size_t largest_size(std::size_t packed, std::uint64_t stated) {
  return static_cast<std::size_t>(std::min<std::uint64_t>(stated, 1000 * std::uint64_t{packed} + 65536));
}

struct FreeZstd {
  void operator()(ZSTD_DStream* stream) const { ZSTD_freeDStream(stream); }
};
struct FreeLz4 {
  void operator()(LZ4F_dctx* context) const { LZ4F_freeDecompressionContext(context); }
};

Unpacked unpack_zstd(std::span<const std::uint8_t> packed, std::size_t size) {
  Unpacked unpacked;
  unpacked.bytes.resize(size);
  const std::unique_ptr<ZSTD_DStream, FreeZstd> stream(ZSTD_createDStream());
  ZSTD_inBuffer in{packed.data(), packed.size(), 0};
  ZSTD_outBuffer out{unpacked.bytes.data(), unpacked.bytes.size(), 0};
  while (in.pos < in.size && out.pos < out.size) {
    const std::size_t before = in.pos + out.pos;
    const std::size_t result = ZSTD_decompressStream(stream.get(), &out, &in);
    if (ZSTD_isError(result) != 0) {
      unpacked.problem = ZSTD_getErrorName(result);
      break;
    }
    if (in.pos + out.pos == before) break;
  }
  unpacked.bytes.resize(out.pos);
  return unpacked;
}

Unpacked unpack_lz4(std::span<const std::uint8_t> packed, std::size_t size) {
  Unpacked unpacked;
  unpacked.bytes.resize(size);
  LZ4F_dctx* raw = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&raw, LZ4F_VERSION)) != 0) return {{}, "out of memory"};
  const std::unique_ptr<LZ4F_dctx, FreeLz4> context(raw);
  std::size_t read = 0;
  std::size_t written = 0;
  while (read < packed.size() && written < size) {
    std::size_t n_in = packed.size() - read;
    std::size_t n_out = size - written;
    const std::size_t result = LZ4F_decompress(context.get(), unpacked.bytes.data() + written, &n_out,
                                               packed.data() + read, &n_in, nullptr);
    if (LZ4F_isError(result) != 0) {
      unpacked.problem = LZ4F_getErrorName(result);
      break;
    }
    if (n_in + n_out == 0) break;
    read += n_in;
    written += n_out;
  }
  unpacked.bytes.resize(written);
  return unpacked;
}

}  // namespace

Unpacked decompress(std::string_view method, std::span<const std::uint8_t> packed, std::uint64_t size) {
  const std::size_t largest = largest_size(packed.size(), size);
  Unpacked unpacked;
  if (method == "zstd")
    unpacked = unpack_zstd(packed, largest);
  else if (method == "lz4")
    unpacked = unpack_lz4(packed, largest);
  else
    unpacked.problem = fmt::format("compression {} is not known", method);
  if (unpacked.problem.empty() && unpacked.bytes.size() < size)
    unpacked.problem = fmt::format("{} bytes came out of {}", unpacked.bytes.size(), size);
  return unpacked;
}

}  // namespace ident::mcap
