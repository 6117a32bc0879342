// SPDX-License-Identifier: Apache-2.0
#include "adapters/http/json_arguments.h"

#include <gtest/gtest.h>

#include "tagfield/base/error.h"

namespace tagfield::http {
namespace {

std::string fault(const std::string& body, void (*use)(JsonArguments&)) {
  try {
    JsonArguments arguments(body);
    use(arguments);
    arguments.finish();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(JsonArguments, AreTakenOneByOne) {
  JsonArguments body(R"({"id": "tag 1", "db": 3.5, "position": [1, -2, 3e0]})");
  EXPECT_TRUE(body.has("db"));
  EXPECT_FALSE(body.has("x"));
  EXPECT_EQ(body.text("id"), "tag 1");
  EXPECT_EQ(body.number("db", 0.0, 10.0), 3.5);
  EXPECT_EQ(body.number("x", 0.0, 10.0, 7.0), 7.0);
  EXPECT_EQ(body.numbers("position", 3, 10.0), (std::vector<double>{1.0, -2.0, 3.0}));
  body.finish();
  JsonArguments("").finish();
}

TEST(JsonArguments, FaultsNameTheKey) {
  const auto nothing = [](JsonArguments&) {};
  const auto number = [](JsonArguments& body) { body.number("n", 0.0, 1.0); };
  const auto numbers = [](JsonArguments& body) { body.numbers("n", 2, 1.0); };
  const auto text = [](JsonArguments& body) { body.text("n"); };
  EXPECT_EQ(fault("{", nothing), "the body is not JSON");
  EXPECT_EQ(fault(R"({"n": 1, "m": {"n": [{"n": 2}]}, "n": 3})", number), "'n' is given twice");
  EXPECT_EQ(fault(R"({"m": [{"k": 1}, {"k": 1, "k": 2}]})", nothing), "'k' is given twice");
  EXPECT_EQ(fault(R"({"n": 0.5, "m": {"n": [{"n": 2}]}})", number),
            "'m' is not known here (did you mean 'n'?)");
  EXPECT_EQ(fault("[1]", nothing), "the body must be a JSON object");
  EXPECT_EQ(fault(R"({"n": 1})", nothing), "'n' is not known here");
  EXPECT_EQ(fault("{}", number), "'n' is missing");
  EXPECT_EQ(fault(R"({"m": 1})", number), "'n' is missing");
  EXPECT_EQ(fault(R"({"N": 1})", number), "'n' is missing (did you mean it by 'N'?)");
  EXPECT_EQ(fault(R"({"n": "1"})", number), "'n' must be a number");
  EXPECT_EQ(fault(R"({"n": 2})", number), "'n' must be from 0 to 1, is 2");
  EXPECT_NE(fault(R"({"n": 1e999})", number), "");
  EXPECT_EQ(fault(R"({"n": [1]})", numbers), "'n' must be a list of 2 numbers");
  EXPECT_EQ(fault(R"({"n": [1, null]})", numbers), "each number of 'n' must be a number");
  EXPECT_EQ(fault(R"({"n": ""})", text),
            "'n' must have 1 to 1000 bytes without control characters");
  EXPECT_NE(fault("{\"n\": \"a\\u0000b\"}", text), "");
  EXPECT_NE(fault(std::string(60000, '['), nothing), "");
}

}  // namespace
}  // namespace tagfield::http
