// SPDX-License-Identifier: Apache-2.0
/// @file
/// Access checks of a server on a user's machine.
#pragma once

#include <string>
#include <string_view>

namespace tagfield::http {

/// Whether a request's Host header names this machine: an IP address, localhost or `own_name`, with
/// or without a port. Rejects foreign sites whose name resolves to this machine (DNS rebinding).
bool is_own_host(std::string_view host, std::string_view own_name);

/// Whether a request with this Origin header ("" for none) comes from our own page, or not from a
/// page at all.
bool is_own_origin(std::string_view origin, std::string_view host);

/// Whether both are equal, compared in a time that does not depend on how much of them matches.
bool is_same_secret(std::string_view given, std::string_view secret);

/// 128 random bits from the system's generator, as hexadecimal digits.
std::string new_token();

}  // namespace tagfield::http
