// Walks over the messages of a binary DataFlash log.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <memory>

#include "ident/io/dataflash/facts.h"
#include "ident/io/dataflash/format.h"
#include "ident/io/dataflash/layout.h"
#include "ident/io/dataflash/units.h"
#include "ident/io/packed/damage.h"
#include "ident/io/packed/little_endian.h"

namespace ident {
namespace {

using dataflash::Layout;

constexpr char kHead1 = '\xA3', kHead2 = '\x95';
constexpr std::size_t kHeaderReader = 3;  // bytes: A3 95, kind of message
constexpr int kFormatKind = 128;          // FMT, which describes itself as the others
constexpr std::size_t kFormat = 86;  // bytes of an FMT behind its header: u8 u8 char[4] char[16] char[64]

constexpr std::array<std::string_view, 5> kTellOfTheLog = {"PARM", "MSG", "UNIT", "MULT", "FMTU"};

struct Kind {
  Layout layout;
  int id = 0;
  bool tells_of_the_log = false;      ///< its messages say something of parameters, units or the vehicle
  std::vector<std::uint64_t> begins;  ///< of its messages in the file
};

class Reader {
 public:
  Reader(std::string_view bytes, const std::string& file) : bytes_(bytes), damage_(out_.damage) {
    out_.file = file;
    out_.format = "dataflash";
  }

  LogStreams run() {
    while (bytes_.size() - at_ >= kHeaderReader)
      if (!take_message()) break;
    if (skipped_ > 0) damage_.add(at_ - skipped_, fmt::format("{} bytes are no message", skipped_));
    for (const std::unique_ptr<Kind>& kind : kinds_) make_stream(*kind);
    damage_.close();
    return std::move(out_);
  }

 private:
  /// False where the file ends within a message.
  bool take_message() {
    const char* const begin = bytes_.data() + at_;
    const bool is_head = begin[0] == kHead1 && begin[1] == kHead2;
    const int id = static_cast<unsigned char>(begin[2]);
    if (is_head && id == kFormatKind) {
      if (bytes_.size() - at_ < kHeaderReader + kFormat) return false;
      end_of_skipped();
      take_format(bytes_.substr(at_ + kHeaderReader, kFormat));
      at_ += kHeaderReader + kFormat;
      return true;
    }
    Kind* const kind = is_head ? of_id_[static_cast<std::size_t>(id)] : nullptr;
    if (kind == nullptr) {
      ++skipped_;
      ++at_;
      return true;
    }
    if (bytes_.size() - at_ < kind->layout.length) return false;
    end_of_skipped();
    kind->begins.push_back(at_);
    if (kind->tells_of_the_log) use(*kind, bytes_.substr(at_, kind->layout.length));
    at_ += kind->layout.length;
    return true;
  }

  void end_of_skipped() {
    if (skipped_ > 0) damage_.add(at_ - skipped_, fmt::format("{} bytes are no message", skipped_));
    skipped_ = 0;
  }

  void take_format(std::string_view body) {
    const int id = static_cast<unsigned char>(body[0]);
    const std::size_t length = static_cast<unsigned char>(body[1]);
    if (id == kFormatKind) return;
    std::optional<Layout> layout = dataflash::make_layout(dataflash::fixed_text(body.substr(2, 4)),
                                                          dataflash::fixed_text(body.substr(6, 16)),
                                                          dataflash::fixed_text(body.substr(22, 64)), length);
    if (!layout) {
      damage_.add(at_, fmt::format("the format of message {} contradicts its length", id));
      return;
    }
    Kind*& known = of_id_[static_cast<std::size_t>(id)];
    if (known != nullptr && known->layout.name == layout->name && known->layout.length == layout->length)
      return;
    const bool tells = std::ranges::find(kTellOfTheLog, layout->name) != kTellOfTheLog.end();
    kinds_.push_back(std::make_unique<Kind>(Kind{std::move(*layout), id, tells, {}}));
    known = kinds_.back().get();
  }

  /// Messages that speak of the log itself.
  void use(const Kind& kind, std::string_view message) {
    const std::string& name = kind.layout.name;
    if (name == "PARM")
      use_parameter(kind.layout, message);
    else if (name == "MSG")
      facts_.take_message(text(kind.layout, "Message", message));
    else if (name == "UNIT" && byte(kind.layout, "Id", message))
      units_.name_unit(static_cast<char>(*byte(kind.layout, "Id", message)),
                       text(kind.layout, "Label", message));
    else if (name == "MULT" && byte(kind.layout, "Id", message))
      units_.name_multiplier(static_cast<char>(*byte(kind.layout, "Id", message)),
                             number(kind.layout, "Mult", message).value_or(1.0));
    else if (name == "FMTU" && byte(kind.layout, "FmtType", message))
      units_.assign(*byte(kind.layout, "FmtType", message), text(kind.layout, "UnitIds", message),
                    text(kind.layout, "MultIds", message));
  }

  void use_parameter(const Layout& layout, std::string_view message) {
    const std::optional<double> value = number(layout, "Value", message);
    if (!value) return;
    const dataflash::Clock clock = dataflash::clock_of(layout);
    std::optional<double> t = number(layout, clock.field, message);
    if (t) *t *= clock.unit;
    facts_.take_parameter(text(layout, "Name", message), *value, t);
  }

  static std::string_view text(const Layout& layout, std::string_view column, std::string_view message) {
    const dataflash::TextColumn* at = layout.text(column);
    return at ? dataflash::fixed_text(message.substr(at->offset, at->size)) : std::string_view();
  }

  static std::optional<double> number(const Layout& layout, std::string_view column,
                                      std::string_view message) {
    const PackedField* field = layout.field(column);
    if (!field) return std::nullopt;
    PackedField there = *field;
    there.offset = 0;
    return unpack(message, {field->offset}, {there}).front().at(0);
  }

  /// A number of one byte, signed or not; empty where a damaged format makes something else of it.
  static std::optional<int> byte(const Layout& layout, std::string_view column, std::string_view message) {
    const std::optional<double> value = number(layout, column, message);
    return value && *value >= -128 && *value <= 255 ? std::optional(static_cast<int>(*value)) : std::nullopt;
  }

  void make_stream(Kind& kind) {
    const std::string& name = kind.layout.name;
    if (kind.begins.empty() || kind.layout.fields.empty() || name == "FMTU" || name == "UNIT" ||
        name == "MULT")
      return;
    for (std::size_t i = 0; i < kind.layout.fields.size(); ++i)
      kind.layout.fields[i].unit = units_.unit(kind.id, kind.layout.place[i], kind.layout.fields[i].scale);
    LogStream stream;
    stream.name = name;
    stream.fields = unpack(bytes_, kind.begins, kind.layout.fields);
    std::vector<std::uint64_t>().swap(kind.begins);
    const dataflash::Clock clock = dataflash::clock_of(kind.layout);
    if (!clock.field.empty()) set_clock(stream, clock.field, 0, clock.unit);
    out_.streams.push_back(std::move(stream));
  }

  std::string_view bytes_;
  LogStreams out_;
  DamageNotes damage_;
  std::size_t at_ = 0, skipped_ = 0;
  std::vector<std::unique_ptr<Kind>> kinds_;
  std::array<Kind*, 256> of_id_{};
  dataflash::Facts facts_{out_};
  dataflash::Units units_;
};

}  // namespace

bool DataflashFormat::recognises(std::string_view first) {
  return first.size() >= kHeaderReader && first[0] == kHead1 && first[1] == kHead2 &&
         static_cast<unsigned char>(first[2]) == kFormatKind;
}

LogStreams DataflashFormat::read(std::string_view bytes, const std::string& file) {
  return Reader(bytes, file).run();
}

}  // namespace ident
