// Frames of a blackbox log: fields with predictor and encoding, I and P frames, slow frames, events.
#pragma once

#include "blackbox_encoding.h"

namespace written {

enum Predictor {
  kZero = 0,
  kPrevious = 1,
  kLine = 2,
  kAverage = 3,
  kMinThrottle = 4,
  kMotor0 = 5,
  kIncrement = 6,
  k1500 = 8,
  kVbatRef = 9,
  kMinMotor = 11
};
enum Encoding {
  kSignedVb = 0,
  kUnsignedVb = 1,
  kNeg14 = 3,
  kTag8Svb = 6,
  kTag2 = 7,
  kTag8S16 = 8,
  kNull = 9
};

struct BlackboxField {
  std::string name;
  bool is_signed;
  Predictor i_predictor;
  Encoding i_encoding;
  Predictor p_predictor;
  Encoding p_encoding;
};

struct BlackboxConstants {
  std::int32_t vbat_ref, min_motor;
};

class BlackboxFile {
 public:
  BlackboxFile(std::vector<BlackboxField> fields, const BlackboxConstants& constants);
  void header(const std::string& key, const std::string& value) {
    out_.text("H " + key + ":" + value + "\n");
  }
  void field_headers();
  void intra(const std::vector<std::int32_t>& values);
  void inter(const std::vector<std::int32_t>& values);
  void slow(std::uint32_t mode_flags, std::uint32_t state_flags);
  void beep(std::uint32_t time_us);
  void end(std::uint32_t reason);
  void write(const std::string& path) const { out_.write(path); }

 private:
  std::int32_t predict(Predictor predictor, size_t field, const std::vector<std::int32_t>& now) const;

  Bytes out_;
  std::vector<BlackboxField> fields_;
  BlackboxConstants constants_;
  std::vector<std::int32_t> before_, before_that_;
  size_t motor0_ = 0;
};

}  // namespace written
