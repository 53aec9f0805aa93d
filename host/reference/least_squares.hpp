// Weighted least squares with several right sides.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

namespace eyeray::engine::reference {

// Fits values by a constant and a coefficient for each term.
class LeastSquares {
 public:
  LeastSquares(int terms, int values)
      : unknowns_(terms + 1), values_(values), rows_(size_t(unknowns_) * size_t(unknowns_ + values)) {}

  // Adds terms and values with a weight.
  void add(double weight, std::span<const double> terms, const double* values) {
    const auto term = [&](int i) { return i == 0 ? 1.0 : terms[size_t(i) - 1]; };
    for (int i = 0; i < unknowns_; ++i) {
      for (int j = 0; j < unknowns_; ++j) at(i, j) += weight * term(i) * term(j);
      for (int c = 0; c < values_; ++c) at(i, unknowns_ + c) += weight * term(i) * values[c];
    }
  }

  // The constants of all values, by Gauss and Jordan's elimination. A coefficient's square costs `cost` times
  // the sum of the weights.
  std::vector<double> constants(double cost) const {
    LeastSquares left = *this;
    for (int i = 1; i < unknowns_; ++i) left.at(i, i) += cost * at(0, 0);
    for (int k = 0; k < unknowns_; ++k) {
      int best = k;
      for (int i = k + 1; i < unknowns_; ++i)
        if (std::abs(left.at(i, k)) > std::abs(left.at(best, k))) best = i;
      for (int j = 0; j < unknowns_ + values_; ++j) std::swap(left.at(k, j), left.at(best, j));
      for (int i = 0; i < unknowns_; ++i) {
        const double factor = i == k ? 0 : left.at(i, k) / left.at(k, k);
        for (int j = k; j < unknowns_ + values_; ++j) left.at(i, j) -= factor * left.at(k, j);
      }
    }
    std::vector<double> result;
    for (int c = 0; c < values_; ++c) result.push_back(left.at(0, unknowns_ + c) / left.at(0, 0));
    return result;
  }

 private:
  double& at(int row, int column) {
    return rows_[size_t(row) * size_t(unknowns_ + values_) + size_t(column)];
  }
  double at(int row, int column) const {
    return rows_[size_t(row) * size_t(unknowns_ + values_) + size_t(column)];
  }

  int unknowns_, values_;
  std::vector<double> rows_;
};

}  // namespace eyeray::engine::reference
