// SPDX-License-Identifier: Apache-2.0
#include "adapters/mcap/internal/compression.h"

#include <fmt/format.h>
#include <lz4frame.h>
#include <zstd.h>

#include <memory>

#include "tagfield/base/error.h"

namespace tagfield::mcap_internal {
namespace {

constexpr const char* kWrongSize = "it does not decompress to its size";

void compress_lz4(std::string_view bytes, std::string& out) {
  const std::size_t before = out.size();
  out.resize(before + LZ4F_compressFrameBound(bytes.size(), nullptr));
  const std::size_t size = LZ4F_compressFrame(out.data() + before, out.size() - before,
                                              bytes.data(), bytes.size(), nullptr);
  if (LZ4F_isError(size) != 0) throw Error(fmt::format("LZ4: {}", LZ4F_getErrorName(size)));
  out.resize(before + size);
}

void compress_zstd(std::string_view bytes, std::string& out) {
  const std::size_t before = out.size();
  out.resize(before + ZSTD_compressBound(bytes.size()));
  const std::size_t size = ZSTD_compress(out.data() + before, out.size() - before, bytes.data(),
                                         bytes.size(), ZSTD_CLEVEL_DEFAULT);
  if (ZSTD_isError(size) != 0) throw Error(fmt::format("Zstandard: {}", ZSTD_getErrorName(size)));
  out.resize(before + size);
}

struct FreeLz4 {
  void operator()(LZ4F_dctx* context) const { LZ4F_freeDecompressionContext(context); }
};

/// One or several complete frames.
const char* decompress_lz4(std::string_view bytes, std::string& out) {
  LZ4F_dctx* made = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&made, LZ4F_VERSION)) != 0) {
    return "there is not enough memory for LZ4";
  }
  const std::unique_ptr<LZ4F_dctx, FreeLz4> context(made);
  std::size_t filled = 0;
  std::size_t awaited = 0;
  while (!bytes.empty()) {
    std::size_t taken = bytes.size();
    std::size_t given = out.size() - filled;
    awaited = LZ4F_decompress(made, out.data() + filled, &given, bytes.data(), &taken, nullptr);
    if (LZ4F_isError(awaited) != 0) return "it is not LZ4";
    if (taken == 0 && given == 0) return kWrongSize;  // There is more output than expected.
    bytes.remove_prefix(taken);
    filled += given;
  }
  return awaited == 0 && filled == out.size() ? nullptr : kWrongSize;
}

const char* decompress_zstd(std::string_view bytes, std::string& out) {
  const std::size_t size = ZSTD_decompress(out.data(), out.size(), bytes.data(), bytes.size());
  if (ZSTD_isError(size) != 0) return "it is not Zstandard of the stated size";
  return size == out.size() ? nullptr : kWrongSize;
}

}  // namespace

std::string_view name_of(McapCompression compression) {
  if (compression == McapCompression::kNone) return "";
  return compression == McapCompression::kLz4 ? "lz4" : "zstd";
}

void compress(McapCompression compression, std::string_view bytes, std::string& out) {
  if (compression == McapCompression::kNone) out += bytes;
  if (compression == McapCompression::kLz4) compress_lz4(bytes, out);
  if (compression == McapCompression::kZstd) compress_zstd(bytes, out);
}

const char* decompress(std::string_view compression, std::string_view bytes, std::size_t size,
                       std::string& out) {
  const bool is_lz4 = compression == "lz4";
  if (compression.empty()) {
    out = bytes;
    return bytes.size() == size ? nullptr : "its size is wrong";
  }
  if (!is_lz4 && compression != "zstd") {
    return "its compression is unknown, expected none, lz4 or zstd";
  }
  out.resize(size);
  return is_lz4 ? decompress_lz4(bytes, out) : decompress_zstd(bytes, out);
}

}  // namespace tagfield::mcap_internal
