// Messages of ROS 2: definitions in both languages, their bytes, and the streams they make.
#include <gtest/gtest.h>

#include <cmath>

#include "ident/io/ros2/common_definitions.h"
#include "ident/io/ros2/idl_text.h"
#include "ident/io/ros2/message_columns.h"
#include "ident/io/ros2/msg_text.h"
#include "ident/io/ros2/topic.h"
#include "support/bag_bytes.h"

namespace ident::ros2 {
namespace {

std::span<const std::uint8_t> span_of(const std::string& bytes) {
  return {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()};
}

constexpr std::string_view text =
    "# A comment\nstd_msgs/Header header\nint16 LIMIT=5\nstring<=10 NAME = \"a # b\"\nstring name \"x\"\n"
    "float32[2] pair\nInner[<=3] inner # more\nuint8[] data\nbool[3] flags\n"
    "================\nMSG: test_msgs/Inner\nint8 i\nfloat64 f 0.5\n"
    "================\nMSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n"
    "================\nMSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n";

constexpr std::string_view idl =
    "================\nIDL: test_msgs/msg/Test\n// generated\n#include \"std_msgs/msg/Header.idl\"\n"
    "module test_msgs {\n  module msg {\n    module Test_Constants { const int16 LIMIT = 5; };\n"
    "    typedef float float__2[2];\n    typedef boolean boolean__3[3];\n"
    "    @verbatim (language=\"comment\", text=\"a (b) \\\" c\")\n    struct Test {\n      "
    "std_msgs::msg::Header header;\n"
    "      @default (value=\"x\")\n      string name;\n      float__2 pair;\n"
    "      sequence<test_msgs::msg::Inner, 3> inner;\n      sequence<uint8> data;\n      boolean__3 flags;\n "
    "   };\n  };\n};\n"
    "================\nIDL: test_msgs/msg/Inner\nmodule test_msgs { module msg { struct Inner { int8 i; "
    "double f; }; }; };\n"
    "================\nIDL: std_msgs/msg/Header\nmodule std_msgs { module msg { struct Header {\n"
    "  builtin_interfaces::msg::Time stamp; string frame_id; }; }; };\n"
    "================\nIDL: builtin_interfaces/msg/Time\nmodule builtin_interfaces { module msg { struct "
    "Time {\n"
    "  long sec; unsigned long nanosec; }; }; };\n";

CdrText head(std::int32_t sec, std::uint32_t nanosec) {
  return CdrText().number(sec).number(nanosec).string("map").string("n").number(1.5f).number(-2.5f);
}

std::string with_inner(std::int32_t sec, std::uint32_t n_inner) {
  CdrText message = head(sec, 500'000'000);
  message.number(n_inner);
  for (std::uint32_t i = 0; i < n_inner; ++i)
    message.number(static_cast<std::int8_t>(-static_cast<int>(i))).number(0.25 * i);
  message.number(std::uint32_t{2}).number(std::uint8_t{250}).number(std::uint8_t{3});
  for (const bool flag : {true, false, true}) message.number(flag);
  return message.bytes();
}

TEST(Ros2Messages, AreReadByDefinitionsInBothLanguages) {
  for (const ParsedDefinitions& parsed : {parse_msg_text("test_msgs/msg/Test", text), parse_idl_text(idl)}) {
    ASSERT_EQ(parsed.problem, "");
    MessageColumns columns(parsed.types, "test_msgs/Test");
    ASSERT_EQ(columns.problem(), "");
    EXPECT_TRUE(columns.add(span_of(with_inner(1, 1))));
    EXPECT_TRUE(columns.add(span_of(with_inner(2, 2))));
    EXPECT_TRUE(columns.add(span_of(with_inner(3, 0))));
    EXPECT_EQ(columns.find("header.stamp.sec")->at(1), 2.0);
    EXPECT_EQ(columns.find("pair[1]")->at(0), -2.5);
    EXPECT_EQ(columns.find("inner[0].f")->at(1), 0.0);
    EXPECT_EQ(columns.find("inner[1].i")->at(1), -1.0);
    EXPECT_EQ(columns.find("inner[1].f")->at(1), 0.25);
    EXPECT_TRUE(std::isnan(columns.find("inner[1].f")->at(0)));
    EXPECT_TRUE(std::isnan(columns.find("inner[0].f")->at(2)));
    EXPECT_EQ(columns.find("data[0]")->at(2), 250.0);
    EXPECT_EQ(columns.find("flags[2]")->at(0), 1.0);
    EXPECT_EQ(columns.find("LIMIT"), nullptr);
    EXPECT_EQ(columns.texts().at("header.frame_id"), "map");
    for (const StreamField& field : columns.take()) EXPECT_EQ(field.size(), 3u) << field.name;
  }
}

TEST(Ros2Messages, ThatDoNotFitTheirTypeAddNothing) {
  const ParsedDefinitions parsed = parse_msg_text("test_msgs/msg/Test", text);
  MessageColumns columns(parsed.types, "test_msgs/Test");
  const std::string whole = with_inner(1, 2);
  for (std::size_t n = 0; n < whole.size(); ++n) EXPECT_FALSE(columns.add(span_of(whole.substr(0, n)))) << n;
  EXPECT_FALSE(columns.add(span_of(whole + std::string(8, 'x'))));
  EXPECT_TRUE(columns.add(span_of(whole)));
  for (const StreamField& field : columns.take()) EXPECT_EQ(field.size(), 1u) << field.name;
}

TEST(Ros2Messages, AreReadInEitherByteOrder) {
  const ParsedDefinitions parsed = parse_msg_text("a/msg/B", "uint8 a\nint32 b\nfloat64 c\n");
  MessageColumns columns(parsed.types, "a/B");
  // Big endian: 7, then -2 at offset 4, then 1.0 = 0x3ff0... at offset 8.
  EXPECT_TRUE(columns.add(span_of(std::string("\0\0\0\0\7\0\0\0\xff\xff\xff\xfe\x3f\xf0\0\0\0\0\0\0", 20))));
  EXPECT_EQ(columns.find("b")->at(0), -2.0);
  EXPECT_EQ(columns.find("c")->at(0), 1.0);
}

TEST(Ros2Messages, OfTypesWithoutEndAreRefused) {
  EXPECT_NE(MessageColumns(parse_msg_text("a/msg/B", "B b\n").types, "a/B").problem().find("contains itself"),
            std::string::npos);
  EXPECT_NE(MessageColumns(parse_msg_text("a/msg/B", "B[200] b\nuint8 c\n").types, "a/B").problem(), "");
  std::string doubling;
  for (int i = 0; i < 15; ++i)
    doubling += "MSG: a/T" + std::to_string(i) + "\nT" + std::to_string(i + 1) + " x\nT" +
                std::to_string(i + 1) + " y\n";
  doubling += "MSG: a/T15\nuint8 z\n";
  EXPECT_NE(MessageColumns(parse_msg_text("a/T0", doubling).types, "a/T0").problem().find("more than"),
            std::string::npos);
}

TEST(Ros2Messages, LargeArraysArePassedOver) {
  const ParsedDefinitions parsed =
      parse_msg_text("a/msg/B", "uint8[1000] image\nuint16[] cloud\nint32 after\n");
  MessageColumns columns(parsed.types, "a/B");
  CdrText message;
  for (int i = 0; i < 1000; ++i) message.number(std::uint8_t{1});
  message.number(std::uint32_t{100});
  for (std::uint16_t i = 0; i < 100; ++i) message.number(i);
  EXPECT_TRUE(columns.add(span_of(message.number(std::int32_t{-5}).bytes())));
  EXPECT_EQ(columns.find("after")->at(0), -5.0);
  EXPECT_EQ(columns.find("cloud[63]")->at(0), 63.0);
  EXPECT_EQ(columns.find("cloud[64]"), nullptr);
  EXPECT_EQ(columns.find("image[0]"), nullptr);
}

LogStreams streams_of(const std::string& type, std::string_view definition,
                      const std::vector<std::string>& messages) {
  std::vector<Topic> topics;
  topics.emplace_back("/topic", type, parse_msg_text(type, definition).types);
  std::int64_t log_time_ns = 1'700'000'000'000'000'000;
  for (const std::string& message : messages) topics[0].add(log_time_ns += 100'000'000, span_of(message));
  LogStreams streams;
  add_topics(topics, streams);
  return streams;
}

TEST(Ros2Topics, TakeTheTimeOfTheStampBeforeThatOfTheRecorder) {
  const std::string types = "std_msgs/Header header\n" + std::string(text.substr(text.find("====")));
  const auto stamped = [](std::int32_t sec, std::uint32_t nanosec) {
    return CdrText().number(sec).number(nanosec).string("").bytes();
  };
  // 20 and 10 ms before they were recorded, at 0.1 s from each other.
  const LogStreams real =
      streams_of("a/msg/B", types, {stamped(1'700'000'000, 80'000'000), stamped(1'700'000'000, 190'000'000)});
  EXPECT_EQ(real.streams[0].clock, "header.stamp");
  EXPECT_NEAR(real.streams[0].t[0], -0.02, 1e-9);
  EXPECT_NEAR(real.streams[0].t[1], 0.09, 1e-9);
  // Simulated time: the first lies where it was recorded.
  const LogStreams simulated = streams_of("a/msg/B", types, {stamped(5, 0), stamped(5, 50'000'000)});
  EXPECT_NEAR(simulated.streams[0].t[0], 0.0, 1e-9);
  EXPECT_NEAR(simulated.streams[0].t[1], 0.05, 1e-9);
  // No stamps at all.
  const LogStreams none = streams_of("a/msg/B", types, {stamped(0, 0), stamped(0, 0)});
  EXPECT_EQ(none.streams[0].clock, "");
  EXPECT_NEAR(none.streams[0].t[1], 0.1, 1e-9);
}

TEST(Ros2Topics, OfPx4TakeTheirTimestamp) {
  const LogStreams px4 = streams_of("px4_msgs/msg/Foo", "uint64 timestamp\nfloat32 x\n",
                                    {CdrText().number(std::uint64_t{1000}).number(1.0f).bytes(),
                                     CdrText().number(std::uint64_t{5000}).number(2.0f).bytes()});
  EXPECT_EQ(px4.streams[0].clock, "timestamp");
  EXPECT_NEAR(px4.streams[0].t[1] - px4.streams[0].t[0], 0.004, 1e-12);
}

TEST(Ros2Topics, AllCommonDefinitionsAreWholeAndCanBePlanned) {
  EXPECT_EQ(common_definitions().count("mavros_msgs/ESCStatus"), 1u);  // the last of the text
  for (const auto& [type, fields] : common_definitions())
    EXPECT_EQ(MessageColumns(common_definitions(), type).problem(), "") << type;
}

}  // namespace
}  // namespace ident::ros2
