// Texts that go into comments and attributes of XML.
#include <gtest/gtest.h>

#include "ident/io/simulators/mjcf/mjcf_model.h"

namespace ident {
namespace {

TEST(XmlText, KeepsTheSignsOfNumbers) {
  EXPECT_EQ(xml_text("95 % [-8.016e-06, 9.584e-06]"), "95 % [-8.016e-06, 9.584e-06]");
}

TEST(XmlText, EndsNoCommentAndNoAttribute) {
  EXPECT_EQ(xml_text("a --> b"), "a - b");
  EXPECT_EQ(xml_text("\"x\" & '<y>'\n"), "x  y");
}

}  // namespace
}  // namespace ident
