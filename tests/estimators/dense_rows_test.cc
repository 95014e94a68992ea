// Dense products and triangular solutions against Eigen, for every instruction set of this machine.
#include "ident/estimators/dense_rows.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <utility>

#include "ident/estimators/flight_chunk_maps.h"

namespace ident {
namespace {

using chunk::RowMatrix;

Rows rows(RowMatrix& M) { return {M.data(), static_cast<int>(M.cols())}; }
ConstRows rows(const RowMatrix& M) { return {M.data(), static_cast<int>(M.cols())}; }

class DenseRowsOf : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    dense_ = dense_rows_with(GetParam());
    if (!dense_) GTEST_SKIP() << "this machine cannot run " << GetParam();
  }
  const DenseRows* dense_ = nullptr;
};

TEST_P(DenseRowsOf, ProductsAreAddedWithTheirSign) {
  for (const auto& [inner, left, right] : {std::array{26, 61, 96}, {1, 1, 8}, {18, 7, 40}, {5, 4, 24}}) {
    const RowMatrix A = RowMatrix::Random(inner, left + 3), B = RowMatrix::Random(inner, padded(right));
    const RowMatrix before = RowMatrix::Random(left, padded(right) + 8);
    for (const double sign : {1.0, -1.0}) {
      RowMatrix C = before;
      dense_->add_products(rows(C), rows(A), left, rows(B), padded(right), inner, sign);
      RowMatrix expected = before;
      expected.leftCols(B.cols()) += sign * A.leftCols(left).transpose() * B;
      EXPECT_LT((C - expected).cwiseAbs().maxCoeff(), 1e-13) << inner << " " << left << " " << right;
    }
  }
}

TEST_P(DenseRowsOf, TriangularSolutionsAreThoseOfTheFactor) {
  for (const int n : {1, 6, 26}) {
    const RowMatrix root = RowMatrix::Random(n, n + 4);
    const RowMatrix L = Eigen::LLT<RowMatrix>(RowMatrix(root * root.transpose())).matrixL();
    const RowMatrix right = RowMatrix::Random(n, 24);
    RowMatrix R = right;
    dense_->forward(rows(L), n, rows(R), 24);
    EXPECT_LT((L * R - right).cwiseAbs().maxCoeff(), 1e-12) << n;
    const RowMatrix half = R;
    dense_->backward(rows(L), n, rows(R), 24);
    EXPECT_LT((L.transpose() * R - half).cwiseAbs().maxCoeff(), 1e-11) << n;
  }
}

INSTANTIATE_TEST_SUITE_P(InstructionSets, DenseRowsOf, testing::Values("baseline", "avx2", "avx512"));

TEST(DenseRows, NoOtherInstructionSetIsKnown) { EXPECT_EQ(dense_rows_with("avx1024"), nullptr); }

}  // namespace
}  // namespace ident
