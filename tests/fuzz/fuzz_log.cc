// Feeds any bytes to one reader of logs: an entry of libFuzzer, built once for each format (CMakeLists.txt).
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "ident/core/error.h"
#include "ident/io/log_formats/all_formats.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  if (!ident::IDENT_FUZZED_FORMAT::recognises(bytes)) return -1;  // not kept in the corpus
  try {
    const ident::LogStreams log = ident::IDENT_FUZZED_FORMAT::read(bytes, "fuzz");
    double sum = 0;
    for (const ident::LogStream& stream : log.streams)
      for (const ident::StreamField& field : stream.fields)
        if (field.size() > 0) sum += field.at(field.size() - 1);
    volatile double used = sum;
    static_cast<void>(used);
  } catch (const ident::Error&) {
  }
  return 0;
}
