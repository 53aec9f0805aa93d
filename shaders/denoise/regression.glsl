// Weighted least squares: colours as a linear function of features, relative to the features of one pixel.
#ifndef DENOISE_REGRESSION_GLSL
#define DENOISE_REGRESSION_GLSL
#include "math/math.glsl"

#include "denoise/lanes.h"
#include "denoise/step.h"

SHADER_BEGIN

#define UNKNOWNS 7                                    // a coefficient for each feature, and last the value at the pixel
#define PRODUCTS 28                                   // UNKNOWNS · (UNKNOWNS + 1) / 2
#define PRODUCT(row, column) ((row) * ((row) + 1) / 2 + (column))  // column ≤ row
#define SIDE(row, color) ((row) * MOST_COLORS + (color))
#define COEFFICIENT_COST 1.0e-3f  // the cost of a squared coefficient, relative to the sum of the weights

struct NormalEquations {
  float matrix[PRODUCTS] PER_LANE;               // the lower triangle, row by row
  float sides[UNKNOWNS * MOST_COLORS] PER_LANE;  // the right sides
};

// Adds a neighbour. `terms`: its features, less those of the pixel. `count`: the number of colours.
IN_CALLER void add_neighbour(INOUT(NormalEquations) sums, const float weight PER_LANE, const float terms[FEATURES] PER_LANE,
                             const float colors[MOST_COLORS] PER_LANE, int count) {
  float weighted[UNKNOWNS] PER_LANE;
  UNROLL for (int i = 0; i < FEATURES; ++i) {
    EACH_LANE weighted[i] LANE = weight LANE * terms[i] LANE;
  }
  EACH_LANE weighted[FEATURES] LANE = weight LANE;
  UNROLL for (int i = 0; i < FEATURES; ++i) {
    UNROLL for (int j = 0; j <= i; ++j) {
      EACH_LANE sums.matrix[PRODUCT(i, j)] LANE += weighted[i] LANE * terms[j] LANE;
    }
    EACH_LANE sums.matrix[PRODUCT(FEATURES, i)] LANE += weighted[i] LANE;
  }
  EACH_LANE sums.matrix[PRODUCT(FEATURES, FEATURES)] LANE += weight LANE;
  UNROLL for (int c = 0; c < count; ++c) {
    UNROLL for (int i = 0; i < UNKNOWNS; ++i) {
      EACH_LANE sums.sides[SIDE(i, c)] LANE += weighted[i] LANE * colors[c] LANE;
    }
  }
}

// Solves the equations by Cholesky's decomposition, and overwrites them. The colours at the pixel, 0 or more, are then in SIDE(FEATURES, c). The
// pixel's own weight, which is 1, keeps the last pivot away from 0.
IN_CALLER void solve(INOUT(NormalEquations) equations, int count) {
  float value PER_LANE;
  float sum PER_LANE;
  EACH_LANE sum LANE = equations.matrix[PRODUCT(FEATURES, FEATURES)] LANE;
  UNROLL for (int i = 0; i < UNKNOWNS; ++i) {
    UNROLL for (int j = 0; j < i; ++j) {
      EACH_LANE value LANE = equations.matrix[PRODUCT(i, j)] LANE;
      UNROLL for (int k = 0; k < j; ++k) {
        EACH_LANE value LANE -= equations.matrix[PRODUCT(i, k)] LANE * equations.matrix[PRODUCT(j, k)] LANE;
      }
      EACH_LANE equations.matrix[PRODUCT(i, j)] LANE = value LANE / equations.matrix[PRODUCT(j, j)] LANE;
    }
    EACH_LANE value LANE = equations.matrix[PRODUCT(i, i)] LANE + (i < FEATURES ? COEFFICIENT_COST * sum LANE : 0.0f);
    UNROLL for (int k = 0; k < i; ++k) {
      EACH_LANE value LANE -= equations.matrix[PRODUCT(i, k)] LANE * equations.matrix[PRODUCT(i, k)] LANE;
    }
    EACH_LANE equations.matrix[PRODUCT(i, i)] LANE = sqrt(maximum(value LANE, 1.0e-6f * sum LANE));
    UNROLL for (int c = 0; c < count; ++c) {
      EACH_LANE value LANE = equations.sides[SIDE(i, c)] LANE;
      UNROLL for (int k = 0; k < i; ++k) {
        EACH_LANE value LANE -= equations.matrix[PRODUCT(i, k)] LANE * equations.sides[SIDE(k, c)] LANE;
      }
      EACH_LANE equations.sides[SIDE(i, c)] LANE = value LANE / equations.matrix[PRODUCT(i, i)] LANE;
    }
  }
  UNROLL for (int c = 0; c < count; ++c) {
    EACH_LANE equations.sides[SIDE(FEATURES, c)] LANE =
        maximum(0.0f, equations.sides[SIDE(FEATURES, c)] LANE / equations.matrix[PRODUCT(FEATURES, FEATURES)] LANE);
  }
}

SHADER_END
#endif
