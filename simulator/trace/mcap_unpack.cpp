// lz4 and zstd, whose output grows with what is really there: a length that a damaged file states is not
// believed.
#include <lz4frame.h>
#include <zstd.h>

#include <algorithm>
#include <memory>
#include <stdexcept>

#include "simulator/trace/mcap_file.h"

namespace plumbline {
namespace {

constexpr std::size_t kStep = 1 << 16;

void require_size(std::uint64_t found, std::uint64_t stated) {
  if (found != stated) {
    throw std::runtime_error(std::to_string(found) + " bytes instead of " + std::to_string(stated));
  }
}

/// Room for more, one byte beyond what was stated at most: enough to see that there is more.
std::size_t grow(std::string& out, std::uint64_t size) {
  const std::size_t filled = out.size();
  const std::uint64_t most = size < SIZE_MAX ? size + 1 : size;
  out.resize(std::max<std::uint64_t>(filled, std::min<std::uint64_t>(most, filled + kStep)));
  return filled;
}

}  // namespace

std::string decompress_lz4(std::string_view bytes, std::uint64_t size) {
  LZ4F_dctx* raw = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&raw, LZ4F_VERSION)) != 0U) {
    throw std::runtime_error("no memory");
  }
  const std::unique_ptr<LZ4F_dctx, LZ4F_errorCode_t (*)(LZ4F_dctx*)> context(raw,
                                                                             LZ4F_freeDecompressionContext);
  std::string out;
  std::size_t status = 0;  // how much more it would like; 0: the frame has ended
  while ((status != 0 || !bytes.empty()) && out.size() <= size) {
    const std::size_t filled = grow(out, size);
    std::size_t written = out.size() - filled;
    std::size_t taken = bytes.size();
    status = LZ4F_decompress(context.get(), out.data() + filled, &written, bytes.data(), &taken, nullptr);
    if (LZ4F_isError(status) != 0U) {
      throw std::runtime_error(LZ4F_getErrorName(status));
    }
    out.resize(filled + written);
    bytes.remove_prefix(taken);
    if (written == 0 && taken == 0) {
      break;  // it wants more than there is
    }
  }
  require_size(out.size(), size);
  return out;
}

std::string decompress_zstd(std::string_view bytes, std::uint64_t size) {
  const std::unique_ptr<ZSTD_DStream, std::size_t (*)(ZSTD_DStream*)> stream(ZSTD_createDStream(),
                                                                             ZSTD_freeDStream);
  ZSTD_inBuffer in{bytes.data(), bytes.size(), 0};
  std::string out;
  bool any = !bytes.empty();
  while (any && out.size() <= size) {
    const std::size_t filled = grow(out, size);
    const std::size_t before = in.pos;
    ZSTD_outBuffer free{out.data() + filled, out.size() - filled, 0};
    const std::size_t status = ZSTD_decompressStream(stream.get(), &free, &in);
    if (ZSTD_isError(status) != 0U) {
      throw std::runtime_error(ZSTD_getErrorName(status));
    }
    out.resize(filled + free.pos);
    any = free.pos > 0 || in.pos > before;
  }
  require_size(out.size(), size);
  return out;
}

}  // namespace plumbline
