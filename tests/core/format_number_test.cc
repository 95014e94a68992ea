// Numbers in tables and reports carry as many digits as their uncertainty allows.
#include "ident/core/format_number.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace ident {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(FormatNumber, RoundsTheValueToTheSecondDigitOfItsDeviation) {
  EXPECT_EQ(format_with_uncertainty(12.3049, 0.451), "12.30 ± 0.45");
  EXPECT_EQ(format_with_uncertainty(-0.0712345, 0.00123), "-0.0712 ± 0.0012");
  EXPECT_EQ(format_with_uncertainty(950.26, 31.4), "950 ± 31");
}

TEST(FormatNumber, TakesThePowerOfTenOutOfSmallAndLargeNumbers) {
  EXPECT_EQ(format_with_uncertainty(6.01432e-6, 1.2e-8), "(6.014 ± 0.012)e-6");
  EXPECT_EQ(format_with_uncertainty(123456, 2300), "(1.235 ± 0.023)e5");
  EXPECT_EQ(format_rounded(6.01432e-6, 1.2e-8), "6.014e-6");
}

TEST(FormatNumber, KeepsTwoDigitsWhenRoundingCarries) {
  EXPECT_EQ(format_with_uncertainty(1.0, 0.0996), "1.00 ± 0.10");
  EXPECT_EQ(format_with_uncertainty(9.9999, 0.010), "10.000 ± 0.010");
  EXPECT_EQ(format_with_uncertainty(9.6e-6, 1.0e-8), "(9.600 ± 0.010)e-6");
  EXPECT_EQ(format_with_uncertainty(9.9999e-6, 1.0e-8), "(1.0000 ± 0.0010)e-5");
}

TEST(FormatNumber, SaysNoMoreThanNineDigitsOfDataWithoutNoise) {
  EXPECT_EQ(format_rounded(0.0029499997579994164, 1.6e-16), "0.0029499997580");
  EXPECT_EQ(format_with_uncertainty(2.0, 1e-17), "2.0000000000 ± 0.0000000020");
  EXPECT_EQ(format_with_uncertainty(0.0, 3.5e-101), "0");
  EXPECT_EQ(format_number(3e-101), "0");
}

TEST(FormatNumber, ShowsAValueFarBelowItsDeviationAsZero) {
  EXPECT_EQ(format_with_uncertainty(-3e-9, 2e-6), "(0.0 ± 2.0)e-6");
  EXPECT_EQ(format_with_uncertainty(0, 0.5), "0.00 ± 0.50");
}

TEST(FormatNumber, WritesTheIntervalWithTheDigitsOfTheValue) {
  EXPECT_EQ(format_interval({5.9908e-6, 6.0378e-6}, 6.0143e-6, 1.2e-8), "[5.991, 6.038]e-6");
  EXPECT_EQ(format_interval({0.9, 1.1}, 1.0, 0.05), "[0.900, 1.100]");
}

TEST(FormatNumber, FallsBackToSignificantDigitsWithoutADeviation) {
  EXPECT_EQ(format_with_uncertainty(0.25, 0), "0.25");
  EXPECT_EQ(format_number(3.14159e-7, 2), "3.1e-7");
  EXPECT_EQ(format_number(1520), "1520");
  EXPECT_EQ(format_number(-12345.6), "-12346");
  EXPECT_EQ(format_number(1e-3), "0.001");
}

TEST(FormatNumber, WritesADashForWhatIsNotFinite) {
  EXPECT_EQ(format_number(std::nan("")), "–");
  EXPECT_EQ(format_with_uncertainty(kInfinity, 1), "–");
  EXPECT_EQ(format_interval({std::nan(""), std::nan("")}, 1, 1), "–");
}

}  // namespace
}  // namespace ident
