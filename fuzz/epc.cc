// SPDX-License-Identifier: Apache-2.0
// EPCs as URIs, as hexadecimals and as patterns, and the specification of events, as selected by
// the first byte.
#include "tagfield/epc/epc.h"

#include "fuzz/input.h"
#include "tagfield/epc/epc_pattern.h"
#include "tagfield/events/events_yaml.h"

namespace tagfield::fuzz {
namespace {

/// A parsed EPC must survive a round trip.
void convert(const std::string& text) {
  const Epc epc = epc_from_uri(text);
  if (id_uri(epc_from_bytes(epc_bytes(epc))) != id_uri(epc)) std::abort();
}

}  // namespace
}  // namespace tagfield::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace tagfield;
  if (size == 0) return 0;
  const std::string text(fuzz::text_of(data + 1, size - 1));
  return fuzz::refused_or_taken([&] {
    switch (data[0] % 4) {
      case 0:
        fuzz::convert(text);
        break;
      case 1:
        epc_to_match(text);
        bits_of_id(text);
        break;
      case 2:
        matches(parse_epc_pattern(text), epc_to_match("urn:epc:id:sgtin:0614141.812345.7"));
        break;
      default:
        read_events_spec(fuzz::folder().write("events.yaml", text));
    }
  });
}
