// Prediction from the last two frames, and runs of fields that share a tag.
#include "blackbox_file.h"

#include <utility>

namespace written {
namespace {

size_t run_length(const std::vector<BlackboxField>& fields, size_t first, size_t longest) {
  size_t n = 1;
  while (n < longest && first + n < fields.size() && fields[first + n].p_encoding == fields[first].p_encoding)
    ++n;
  return n;
}

}  // namespace

BlackboxFile::BlackboxFile(std::vector<BlackboxField> fields, const BlackboxConstants& constants)
    : fields_(std::move(fields)), constants_(constants) {
  while (motor0_ < fields_.size() && fields_[motor0_].name != "motor[0]") ++motor0_;
  header("Product", "Blackbox flight data recorder by Nicholas Sherlock");
  header("Data version", "2");
}

void BlackboxFile::field_headers() {
  const auto list = [&](const std::string& key, auto value) {
    std::string text;
    for (const BlackboxField& field : fields_) text += (text.empty() ? "" : ",") + value(field);
    header(key, text);
  };
  list("Field I name", [](const BlackboxField& f) { return f.name; });
  list("Field I signed", [](const BlackboxField& f) { return std::to_string(f.is_signed); });
  list("Field I predictor", [](const BlackboxField& f) { return std::to_string(f.i_predictor); });
  list("Field I encoding", [](const BlackboxField& f) { return std::to_string(f.i_encoding); });
  list("Field P predictor", [](const BlackboxField& f) { return std::to_string(f.p_predictor); });
  list("Field P encoding", [](const BlackboxField& f) { return std::to_string(f.p_encoding); });
  header("Field S name", "flightModeFlags,stateFlags,failsafePhase,rxSignalReceived,rxFlightChannelsValid");
  header("Field S signed", "0,0,0,0,0");
  header("Field S predictor", "0,0,0,0,0");
  header("Field S encoding", "1,1,7,7,7");
}

std::int32_t BlackboxFile::predict(Predictor predictor, size_t i,
                                   const std::vector<std::int32_t>& now) const {
  switch (predictor) {
    case kPrevious:
      return before_[i];
    case kLine:
      return 2 * before_[i] - before_that_[i];
    case kAverage:
      return (before_[i] + before_that_[i]) / 2;
    case kMotor0:
      return now[motor0_];
    case k1500:
      return 1500;
    case kVbatRef:
      return constants_.vbat_ref;
    case kMinMotor:
      return constants_.min_motor;
    default:
      return 0;
  }
}

void BlackboxFile::intra(const std::vector<std::int32_t>& values) {
  out_.put('I');
  for (size_t i = 0; i < fields_.size(); ++i) {
    const std::int32_t rest = values[i] - predict(fields_[i].i_predictor, i, values);
    switch (fields_[i].i_encoding) {
      case kUnsignedVb:
        unsigned_vb(out_, static_cast<std::uint32_t>(rest));
        break;
      case kNeg14:
        unsigned_vb(out_, static_cast<std::uint32_t>(-rest) & 0x3fff);
        break;
      default:
        signed_vb(out_, rest);
        break;
    }
  }
  before_ = before_that_ = values;
}

void BlackboxFile::inter(const std::vector<std::int32_t>& values) {
  std::vector<std::int32_t> rest;
  for (size_t i = 0; i < fields_.size(); ++i)
    rest.push_back(values[i] - predict(fields_[i].p_predictor, i, values));
  out_.put('P');
  for (size_t i = 0; i < fields_.size();) {
    const Encoding encoding = fields_[i].p_encoding;
    const size_t n = encoding == kTag2      ? 3
                     : encoding == kTag8S16 ? 4
                     : encoding == kTag8Svb ? run_length(fields_, i, 8)
                                            : 1;
    const std::span<const std::int32_t> group(&rest[i], n);
    switch (encoding) {
      case kNull:
        break;
      case kTag2:
        tag2_3s32(out_, group);
        break;
      case kTag8S16:
        tag8_4s16(out_, group);
        break;
      case kTag8Svb:
        tag8_8svb(out_, group);
        break;
      case kUnsignedVb:
        unsigned_vb(out_, static_cast<std::uint32_t>(rest[i]));
        break;
      default:
        signed_vb(out_, rest[i]);
        break;
    }
    i += n;
  }
  before_that_ = std::exchange(before_, values);
}

void BlackboxFile::slow(std::uint32_t mode_flags, std::uint32_t state_flags) {
  out_.put('S');
  unsigned_vb(out_, mode_flags);
  unsigned_vb(out_, state_flags);
  const std::int32_t link[] = {0, 1, 1};
  tag2_3s32(out_, link);
}

void BlackboxFile::beep(std::uint32_t time_us) {
  out_.put('E').put(std::uint8_t{0});
  unsigned_vb(out_, time_us);
}

void BlackboxFile::end(std::uint32_t reason) {
  out_.put('E').put(std::uint8_t{15});  // disarm
  unsigned_vb(out_, reason);
  out_.put('E').put(std::uint8_t{255}).text("End of log").zeros(1);
}

}  // namespace written
