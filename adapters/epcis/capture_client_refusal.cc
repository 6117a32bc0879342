// SPDX-License-Identifier: Apache-2.0
// Replaces capture_client.cc in builds without libcurl.
#include "adapters/epcis/capture_client.h"
#include "tagfield/base/error.h"

namespace tagfield {

class CaptureClient::Impl {};

CaptureClient::CaptureClient(const std::string& /*url*/, const CaptureOptions& /*options*/) {
  throw Error("EPCIS capture: this tagfield was built without libcurl (libcurl4-openssl-dev)");
}

CaptureClient::~CaptureClient() = default;

void CaptureClient::capture(const std::string& /*event*/) {}

void CaptureClient::finish(std::chrono::milliseconds /*patience*/,
                           const std::function<bool()>& /*gives_up*/) {}

CaptureCounts CaptureClient::counts() const { return {}; }

std::string CaptureClient::name() const { return ""; }

}  // namespace tagfield
