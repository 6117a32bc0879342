// SPDX-License-Identifier: Apache-2.0
#include "tagfield/field/radio_port.h"

#include "tagfield/base/random.h"
#include "tagfield/base/units.h"

namespace tagfield {
namespace {

/// RN16 and the reply with the EPC must both be decoded.
constexpr int kRn16Bits = 16;
/// PC and CRC in addition to the EPC.
constexpr int kOverheadBits = 32;

/// A phase in [0, 2π), a fixed function of `key` and `number`.
double drawn_offset(std::uint64_t seed, std::uint64_t key, std::uint64_t number) {
  RandomStream stream(seed, Purpose::kHopping, key, number);
  return kTwoPi * uniform(stream);
}

/// Number 0 of a reader's key is used for its hop order.
double offset_of_channel(const RadioPort& port, std::size_t channel) {
  return drawn_offset(port.seed, port.reader_key, 1 + channel);
}

double offset_of_port(const RadioPort& port) {
  constexpr std::uint64_t kPort = ~std::uint64_t{0};
  return drawn_offset(port.seed, port.antenna_key, kPort);
}

bool has_pi_ambiguity(const RadioModel& model) {
  // Without an inventory, the reader's usual Miller replies are assumed.
  return model.effects.pi_ambiguity && (!model.gen2 || model.gen2->link.encoding != Encoding::kFm0);
}

/// Without simulated noise, a reader decodes replies whose decode probability is at least one half.
bool passes(const RadioModel& model, const RadioLink& link, const Disturbance& disturbance) {
  if (!(disturbance.in_replies_mw > 0.0)) return true;
  return sinr_db(model.hardware, link.reply_dbm, disturbance.in_replies_mw) >=
         required_sinr_db(reply_bits(model));
}

}  // namespace

CarrierNow carrier_at(const RadioModel& model, const RadioPort& port, Time time) {
  CarrierNow now;
  if (model.effects.hopping) {
    // The same order for all readers that share a plan, so that they are never on the same channel.
    now.channel = channel_at(model.plan, time, stream_key(model.plan.name), port.seed, port.turn);
  }
  now.frequency_hz = model.plan.carriers_hz[now.channel];
  now.phase_offset_rad = model.phase_offset_rad;
  if (model.effects.phase_offsets) {
    now.phase_offset_rad += offset_of_channel(port, now.channel) + offset_of_port(port);
  }
  return now;
}

TagReply report(const RadioModel& model, const RadioPort& port, const CarrierNow& carrier,
                const RadioLink& link, const TagEnd& tag, const Eigen::Vector3d& v_AT_W, Time stamp,
                double interference_mw) {
  RandomStream noise(port.seed, Purpose::kMeasuring, port.antenna_key, tag.key,
                     static_cast<std::uint64_t>(stamp.time_since_epoch().count()));
  const ReceiverEffects effects{model.effects.noise, model.effects.quantization,
                                has_pi_ambiguity(model)};
  Reply incoming = reply_of(link, carrier.phase_offset_rad, v_AT_W);
  incoming.interference_mw = interference_mw;
  const Measured measured = measure(model.hardware, effects, incoming, noise);
  TagReply reply;
  reply.stamp = stamp;
  reply.frequency_hz = carrier.frequency_hz;
  reply.phase_rad = measured.phase_rad;
  reply.rssi_dbm = measured.rssi_dbm;
  reply.doppler_hz = measured.doppler_hz;
  return reply;
}

int reply_bits(const RadioModel& model) {
  return kRn16Bits + kOverheadBits + reply_link_of(model).epc_bits;
}

bool is_read(const RadioModel& model, const RadioLink& link, const TagEnd& tag,
             const Disturbance& disturbance) {
  if (!is_heard(link, tag.model, model) || !hears_commands(link, disturbance)) return false;
  return passes(model, link, disturbance);
}

std::optional<TagOnAir> on_air(const RadioModel& model, const RadioLink& link, const TagEnd& tag,
                               const Disturbance& disturbance) {
  if (tag_margin_db(link, tag.model) < 0.0) return std::nullopt;
  if (!hears_commands(link, disturbance)) return std::nullopt;
  TagOnAir on_air;
  on_air.reply_dbm = link.reply_dbm;
  on_air.decode_probability = 0.0;
  if (reader_margin_db(link, model) < 0.0) return on_air;
  if (model.effects.noise) {
    on_air.decode_probability = decode_probability(model.hardware, link.reply_dbm,
                                                   reply_bits(model), disturbance.in_replies_mw);
  } else if (passes(model, link, disturbance)) {
    on_air.decode_probability = 1.0;
  }
  return on_air;
}

}  // namespace tagfield
