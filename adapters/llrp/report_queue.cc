// SPDX-License-Identifier: Apache-2.0
#include "adapters/llrp/report_queue.h"

namespace tagfield::llrp {
namespace {

/// TagReportData per message.
constexpr std::size_t kMaxReportBytes = 32'000;

void append(std::vector<Bytes> reports, std::deque<Bytes>& queue) {
  for (Bytes& report : reports) queue.push_back(std::move(report));
}

}  // namespace

void ReportQueue::shorten(std::deque<Bytes>& queue) {
  while (queue.size() > kMaxPending) {
    queue.pop_front();
    ++dropped_;
  }
}

void ReportQueue::add(std::vector<Bytes> reports, bool may_drop) {
  append(std::move(reports), pending_);
  if (may_drop) shorten(pending_);
}

void ReportQueue::keep(std::vector<Bytes> reports) {
  append(std::move(reports), kept_);
  shorten(kept_);
}

void ReportQueue::release_kept(bool may_drop) {
  const std::deque<Bytes> kept = std::exchange(kept_, {});
  add({kept.begin(), kept.end()}, may_drop);
}

ByteWriter ReportQueue::take_message() {
  ByteWriter body;
  while (!pending_.empty() && body.written().size() < kMaxReportBytes) {
    body.bytes(pending_.front());
    pending_.pop_front();
  }
  return body;
}

}  // namespace tagfield::llrp
