// A list reads as in a sentence.
#include "ident/core/word_list.h"

#include <gtest/gtest.h>

namespace ident {
namespace {

TEST(WordList, HasCommasAndAWordBeforeTheLast) {
  EXPECT_EQ(listed({}), "");
  EXPECT_EQ(listed({"wind"}), "wind");
  EXPECT_EQ(listed({"wind", "drag"}), "wind and drag");
  EXPECT_EQ(listed({"wind", "drag", "inflow"}), "wind, drag and inflow");
}

}  // namespace
}  // namespace ident
