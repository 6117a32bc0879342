// SPDX-License-Identifier: Apache-2.0
/// @file
/// Sends events to an EPCIS 2.0 repository through its capture interface.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace tagfield {

struct CaptureOptions {
  /// Events that are buffered while the repository is unreachable or slow. When the buffer is full,
  /// the oldest are dropped.
  std::size_t max_events = 100'000;
  /// Maximum per document.
  std::size_t events_per_document = 500;
  /// Additional header lines of each request, "Name: value", such as an API key that the repository
  /// requires.
  std::vector<std::string> headers;
  /// For one request.
  std::chrono::milliseconds timeout{30'000};
  /// Receives one line when the repository becomes unreachable, comes back or refuses events, and
  /// when events are lost. Called from any thread; must not call the client. Empty for no warnings.
  std::function<void(const std::string& line)> warn;
};

/// Events by outcome.
struct CaptureCounts {
  std::size_t taken = 0;     ///< Handed to the client.
  std::size_t captured = 0;  ///< Accepted by the repository.
  std::size_t refused = 0;   ///< Rejected by the repository.
  std::size_t lost = 0;      ///< Dropped because the buffer was full or time ran out at the end.
};

/// Posts EPCISDocuments, one after the other, each with the events that have arrived meanwhile. If
/// the repository is unreachable, busy (408, 425, 429) or failing (5xx), a document is posted again
/// after 1, 2, 4, … 30 s, or after the delay that the repository requests (Retry-After, up to 30
/// s), so if a response is lost, an event may be captured twice. A document that is too large (413)
/// is halved. Any other failure counts as a refusal. Redirections aren't followed.
class CaptureClient {
 public:
  /// Doesn't wait for the repository. Throws Error if `url` is not http:// or https://, a header is
  /// malformed, or Tagfield was built without libcurl.
  CaptureClient(const std::string& url, const CaptureOptions& options);
  /// As finish(), but without waiting.
  ~CaptureClient();
  CaptureClient(const CaptureClient&) = delete;
  CaptureClient& operator=(const CaptureClient&) = delete;

  /// Queues an event as made by EpcisEvents, without a context. Callable from any thread; never
  /// waits for the network.
  void capture(const std::string& event);
  /// Waits until the repository has answered for all events. Gives up if it has not answered for
  /// `patience`, or when `gives_up` (which may be empty) returns true, and counts the rest as lost.
  /// No more events are captured after that.
  void finish(std::chrono::milliseconds patience, const std::function<bool()>& gives_up);
  [[nodiscard]] CaptureCounts counts() const;
  /// The repository's address without user and password, for messages.
  [[nodiscard]] std::string name() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tagfield
