// SPDX-License-Identifier: Apache-2.0
/// @file
/// Events to a repository of EPCIS 2.0, by its capture interface.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace tagfield {

struct CaptureOptions {
  /// Events that are kept while the repository is away or slow. Of more the oldest are lost.
  std::size_t most_events = 100'000;
  /// In one document.
  std::size_t events_per_document = 500;
  /// Further lines of each request's header, "Name: value": a key that the repository asks for.
  std::vector<std::string> headers;
  /// How long one request may take.
  std::chrono::milliseconds timeout{30'000};
  /// Gets a line where the repository goes, comes back or refuses, and where events are lost.
  /// Called from any thread; it must not call the client. Empty for silence.
  std::function<void(const std::string& line)> warn;
};

/// What became of events.
struct CaptureCounts {
  std::size_t taken = 0;     ///< Handed to the client.
  std::size_t captured = 0;  ///< The repository said that it has them.
  std::size_t refused = 0;   ///< It said that it won't.
  std::size_t lost = 0;      ///< There was no room for them, or no time left at the end.
};

/// Posts EPCISDocuments of the events that have come meanwhile, one after the other. Where the
/// repository can't be reached, is busy (408, 425, 429) or in trouble (5xx) a document is posted
/// again after 1, 2, 4, … 30 s, or as long as the repository asks for (Retry-After, up to 30 s), so
/// that after a lost answer an event may be there twice. Too large a document (413) is halved. What
/// else is no success is a refusal. Redirections aren't followed.
class CaptureClient {
 public:
  /// Doesn't wait for the repository. Throws Error where `url` is not http:// or https://, a
  /// header is none, or Tagfield was built without libcurl.
  CaptureClient(const std::string& url, const CaptureOptions& options);
  /// finish()es without patience.
  ~CaptureClient();
  CaptureClient(const CaptureClient&) = delete;
  CaptureClient& operator=(const CaptureClient&) = delete;

  /// An event as EpcisEvents makes it, without a context. From any thread; never waits for the
  /// network.
  void capture(const std::string& event);
  /// Waits until the repository has said what it does with all of them, or gives up where it said
  /// nothing for so long or `gives_up` (which may be empty) says so, and counts the rest as lost.
  /// Then nothing more is captured.
  void finish(std::chrono::milliseconds patience, const std::function<bool()>& gives_up);
  [[nodiscard]] CaptureCounts counts() const;
  /// The repository's address without user and password, for messages.
  [[nodiscard]] std::string name() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tagfield
