// SPDX-License-Identifier: Apache-2.0
// A client's messages to a reader, one after the other as on its connection; between two of them
// the world advances for a while.
#include <algorithm>

#include "adapters/llrp/llrp_reader.h"
#include "fuzz/input.h"
#include "fuzz/small_world.h"

namespace tagfield::fuzz {
namespace {

constexpr int kStepsBetween = 3;

/// Checks that each message sent is complete.
class Client final : public llrp::ClientLine {
 public:
  void send(const llrp::Bytes& message, bool /*is_report*/) override {
    if (message.size() < llrp::kHeaderSize || llrp::length_in(message.data()) != message.size()) {
      std::abort();
    }
    const llrp::Message read = llrp::message_of(message);
    // A few messages begin with a field that is not a parameter; these consist of parameters only.
    if (read.type == 61 || read.type == 63 || read.type == 100) {
      llrp::parameters_of(llrp::ByteReader(read.body));
    }
  }
  double level() override { return 0.0; }
  std::int64_t take_dropped() override { return 0; }
};

class Reads final : public ReadListener {
 public:
  explicit Reads(llrp::LlrpReader& reader) : reader_(reader) {}
  void on_read(const TagRead& read) override { reader_.on_read(read); }

 private:
  llrp::LlrpReader& reader_;
};

class ReaderSteps final : public LiveMember {
 public:
  explicit ReaderSteps(llrp::LlrpReader& reader) : reader_(reader) {}
  void on_step(LiveWorld& world, Time now) override { reader_.on_step(world, now); }

 private:
  llrp::LlrpReader& reader_;
};

void converse(const std::uint8_t* data, std::size_t size) {
  llrp::LlrpReader reader("gate", std::make_shared<llrp::TagStore>(), 0, [](const std::string&) {});
  Outlets outlets;
  attach(std::make_shared<Reads>(reader), outlets);
  LiveWorld world(small_hall(), 1, outlets, {0.0, false, false});
  const auto steps = std::make_shared<Steps>();
  world.attach(std::make_shared<ReaderSteps>(reader));
  world.attach(steps);
  reader.connect(world, std::make_shared<Client>());
  while (size >= llrp::kHeaderSize) {
    std::size_t length = 0;
    try {
      length = llrp::length_in(data);
    } catch (const llrp::Fault&) {
      return;  // Closes the connection.
    }
    if (length > size) return;
    const llrp::Bytes bytes(data, data + length);
    if (!reader.on_message(world, llrp::message_of(bytes))) return;
    steps->go_on(world, kStepsBetween);
    data += length;
    size -= length;
  }
}

}  // namespace
}  // namespace tagfield::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  tagfield::fuzz::converse(data, size);
  return 0;
}
