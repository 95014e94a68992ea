// Dense products and triangular solutions against Eigen, for every instruction set of this machine.
#include "ident/core/simd/dense_rows.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <array>

#include "ident/core/random.h"
#include "ident/flight/smoother/chunk_maps.h"

namespace ident {
namespace {

using chunk::RowMatrix;

Rows rows(RowMatrix& M) { return {M.data(), static_cast<int>(M.cols())}; }
ConstRows rows(const RowMatrix& M) { return {M.data(), static_cast<int>(M.cols())}; }

RowMatrix drawn(int rows, int columns, Random& random) {
  RowMatrix M(rows, columns);
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j) M(i, j) = random.normal();
  return M;
}

class DenseRowsOf : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    dense_ = dense_rows_with(GetParam());
    if (!dense_) GTEST_SKIP() << "this machine cannot run " << GetParam();
  }
  const DenseRows* dense_ = nullptr;
};

TEST_P(DenseRowsOf, ProductsAreAddedWithTheirSign) {
  Random random(7);
  for (const auto& [inner, left, right] : {std::array{26, 61, 96}, {1, 1, 8}, {18, 7, 40}, {5, 4, 24}}) {
    const RowMatrix A = drawn(inner, left + 3, random), B = drawn(inner, padded(right), random);
    const RowMatrix before = drawn(left, padded(right) + 8, random);
    for (const double sign : {1.0, -1.0}) {
      RowMatrix C = before;
      dense_->add_products(rows(C), rows(A), left, rows(B), padded(right), inner, sign);
      RowMatrix expected = before;
      expected.leftCols(B.cols()) += sign * A.leftCols(left).transpose() * B;
      EXPECT_LT((C - expected).cwiseAbs().maxCoeff(), 1e-12) << inner << " " << left << " " << right;
    }
  }
}

TEST_P(DenseRowsOf, OfASymmetricProductTheUpperTriangleIsWhole) {
  Random random(9);
  for (const auto& [inner, n] : {std::array{26, 61}, {5, 8}, {18, 13}}) {
    const RowMatrix A = drawn(inner, padded(n + 1), random), before = drawn(n, padded(n + 1), random);
    RowMatrix C = before;
    dense_->add_upper(rows(C), rows(A), n, rows(A), padded(n + 1), inner, -1.0);
    const RowMatrix expected = before - A.leftCols(n).transpose() * A;
    for (int i = 0; i < n; ++i)
      for (int j = i; j < padded(n + 1); ++j) ASSERT_NEAR(C(i, j), expected(i, j), 1e-12) << i << " " << j;
  }
}

TEST_P(DenseRowsOf, TriangularSolutionsAreThoseOfTheFactor) {
  Random random(11);
  for (const int n : {1, 6, 26}) {
    const RowMatrix root = drawn(n, n + 4, random);
    const RowMatrix L = Eigen::LLT<RowMatrix>(RowMatrix(root * root.transpose())).matrixL();
    for (const int columns : {8, 24, 104}) {
      const RowMatrix right = drawn(n, columns + 8, random);
      RowMatrix R = right;
      dense_->forward(rows(L), n, rows(R), columns);
      EXPECT_EQ(R.rightCols(8), right.rightCols(8)) << "beyond the columns asked for";
      EXPECT_LT((L * R - right).leftCols(columns).cwiseAbs().maxCoeff(), 1e-11) << n;
      const RowMatrix half = R;
      dense_->backward(rows(L), n, rows(R), columns);
      EXPECT_LT((L.transpose() * R - half).leftCols(columns).cwiseAbs().maxCoeff(), 1e-9) << n;
    }
  }
}

TEST_P(DenseRowsOf, RowsAreScaledEachByItsWeightAndAddedToTheLastColumn) {
  Random random(13);
  for (const int n : {1, 5, 26}) {
    const RowMatrix weights = drawn(n, 1, random);
    for (const int columns : {8, 24, 104}) {
      const RowMatrix B = drawn(n, columns + 16, random), before = drawn(n, columns + 8, random);
      RowMatrix C = before;
      dense_->scale(rows(C), weights.data(), rows(B), n, columns);
      RowMatrix expected = before;
      expected.leftCols(columns) = weights.col(0).asDiagonal() * B.leftCols(columns);
      EXPECT_EQ(C, expected) << n << " " << columns;
      for (const int odd : {1, columns - 3, columns}) {
        C = before, expected = before;
        dense_->add(rows(C), rows(B), n, odd);
        expected.leftCols(odd) += B.leftCols(odd);
        EXPECT_EQ(C, expected) << n << " " << odd;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(InstructionSets, DenseRowsOf, testing::Values("baseline", "avx2", "avx512"));

TEST(DenseRows, NoOtherInstructionSetIsKnown) { EXPECT_EQ(dense_rows_with("avx1024"), nullptr); }

}  // namespace
}  // namespace ident
