// Turns the messages of one topic into columns: nested fields as `pose.position.x`, elements as `data[3]`.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ident/data/log_streams.h"
#include "ident/io/ros2/cdr.h"
#include "ident/io/ros2/definition.h"

namespace ident::ros2 {

/// Elements of a sequence that become columns; longer ones are images, clouds and the like.
inline constexpr std::uint32_t most_elements = 64;
/// Elements of an array of fixed length that become columns (a covariance of 6 by 6 has 36).
inline constexpr std::uint32_t most_array_elements = 256;
/// Numbers that a message can have altogether.
inline constexpr std::size_t most_columns = 4096;

/// Columns of the numbers in messages of one type. Numbers keep their type; those of sequences, which a
/// message need not have, are floating and NaN where missing. Texts are not columns: the first of each is
/// kept.
class MessageColumns {
 public:
  /// `type` as `geometry_msgs/Pose`.
  MessageColumns(const Definitions& definitions, std::string_view type);

  /// Why messages of this type cannot be read; empty where they can.
  const std::string& problem() const { return problem_; }
  /// Adds a message. False, and nothing added, where its bytes do not fit the type.
  bool add(std::span<const std::uint8_t> message);
  std::size_t rows() const { return rows_; }
  const StreamField* find(std::string_view name) const;
  const std::map<std::string, std::string>& texts() const { return texts_; }
  std::vector<StreamField> take() { return std::move(columns_); }

 private:
  static constexpr std::size_t no_column = static_cast<std::size_t>(-1);

  /// One step in reading a message.
  struct Step {
    Type type = Type::uint8;
    Repeat repeat = Repeat::once;
    std::uint32_t count = 1;                  ///< of an array that has no columns
    std::size_t column = no_column;           ///< of a number; where there is none it is passed over
    std::string name;                         ///< of texts and sequences
    std::vector<Step> element;                ///< of a nested type, without columns
    std::vector<std::vector<Step>> elements;  ///< of a sequence: one plan for each element seen so far
    const MessageField* field = nullptr;
  };
  /// Where a plan is being made: name so far, whether its numbers become columns, how deep, and whether it
  /// belongs to a sequence.
  struct Place {
    std::string prefix;
    bool columns = true;
    bool in_sequence = false;
    int depth = 0;
  };

  void plan_fields(std::string_view type, const Place& place, std::vector<Step>& steps);
  void plan_field(const MessageField& field, const Place& place, std::vector<Step>& steps);
  void plan_single(const MessageField& field, const Place& place, std::vector<Step>& steps);
  std::size_t add_column(const std::string& name, Type type, bool in_sequence);
  void run(std::vector<Step>& steps, CdrReader& in);
  void run_sequence(Step& step, CdrReader& in);
  void read_number(const Step& step, CdrReader& in);
  void even_out(bool good);

  const Definitions& definitions_;
  std::string problem_;
  std::size_t steps_planned_ = 0;
  std::vector<Step> steps_;
  std::vector<StreamField> columns_;
  std::vector<std::size_t> of_sequences_;  ///< columns that a message need not have
  std::map<std::string, std::string> texts_;
  std::size_t rows_ = 0;
};

}  // namespace ident::ros2
