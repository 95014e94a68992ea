// Fits a line through three points and reads a vehicle: what needs Ceres and yaml-cpp behind the library.
#include <ident/io/vehicle/vehicle_read.h>
#include <ident/lsq/least_squares_fit.h>

#include <iostream>

int main(int argc, char** argv) {
  ident::LeastSquaresProblem problem;
  problem.unknowns = {{.name = "slope", .start = 1.0}};
  problem.residuals = 3;
  problem.evaluate = [](const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* J) {
    const Eigen::Vector3d t(1, 2, 3), y(2.1, 3.9, 6.0);
    r = x[0] * t - y;
    if (J != nullptr) J->col(0) = t;
    return true;
  };
  const auto fit = ident::solve_least_squares(problem);
  std::cout << "slope " << fit.x[0] << "\n";
  if (argc > 1) std::cout << "vehicle " << ident::read_vehicle(argv[1]).name << "\n";
}
