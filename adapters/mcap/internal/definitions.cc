// SPDX-License-Identifier: Apache-2.0
#include "adapters/mcap/internal/definitions.h"

#include <fmt/format.h>

#include <utility>

namespace tagfield::mcap_internal {

const char* Definitions::add(Op op, std::string_view content) {
  const bool is_schema = op == Op::kSchema;
  auto& known = is_schema ? schemas_ : channels_;
  const auto id = Fields(content).number<std::uint16_t>();
  if (const auto other = known.find(id); other != known.end()) {
    if (other->second == content) return nullptr;
    return is_schema ? "it differs from an earlier schema of its id, and is left out"
                     : "it differs from an earlier channel of its id, and is left out";
  }
  if (is_schema && !schema_in(content)) return "a schema is broken, and left out";
  if (!is_schema && !channel_in(content)) return "a channel is broken, and left out";
  if (is_schema && id == 0) return "a schema has the id 0, and is left out";
  bytes_ += content.size();
  if (bytes_ > kMaxMcapDefinitionBytes) {
    throw Error(fmt::format("its schemas and channels take more than {} bytes, which is the limit",
                            kMaxMcapDefinitionBytes));
  }
  known.emplace(id, content);
  return nullptr;
}

std::vector<McapChannelId> Definitions::resolve(Contents& contents) const {
  for (const auto& [id, content] : schemas_) {
    contents.schemas[id] = std::make_shared<const McapSchema>(schema_in(content)->schema);
  }
  std::vector<McapChannelId> without_schema;
  for (const auto& [id, content] : channels_) {
    ChannelFields fields = *channel_in(content);
    const auto schema = contents.schemas.find(fields.schema);
    if (schema != contents.schemas.end()) fields.channel.schema = schema->second;
    if (schema == contents.schemas.end() && fields.schema != 0) without_schema.push_back(id);
    contents.channels.emplace(id, std::move(fields.channel));
  }
  return without_schema;
}

}  // namespace tagfield::mcap_internal
