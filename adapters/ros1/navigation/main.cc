// SPDX-License-Identifier: Apache-2.0
#include "adapters/ros1/navigation/nodes.h"

int main(int argc, char** argv) { return tagfield::TAGFIELD_NODE(argc, argv); }
