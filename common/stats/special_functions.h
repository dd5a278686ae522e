// The regularised incomplete gamma and beta functions, on which most distributions stand.
#pragma once

namespace diptych::core {

/// P(a, x), lower; a > 0, x >= 0. Series (DLMF 8.11.4) below x = a + 1, one minus Q above. The relative error grows
/// with a, as the terms of the exponent do: 1e-13 at 100, 1e-11 at 1e4.
double regularized_gamma_lower(double a, double x);

/// Q(a, x) = 1 - P(a, x), without cancellation where it is small: continued fraction (DLMF 8.9.2).
double regularized_gamma_upper(double a, double x);

/// I_x(a, b); a, b > 0, x in [0, 1]. Continued fraction (DLMF 8.17.22), on the side where it converges quickly. Errors
/// as above, with a + b. `one_minus_x` keeps its digits where x is next to 1.
double regularized_beta(double a, double b, double x);
double regularized_beta(double a, double b, double x, double one_minus_x);

}  // namespace diptych::core
