// [numerics]
#include "host/case/case_keys.hpp"

namespace slagflow {
namespace {

const Words kernel_names(smoothing_names.begin(), smoothing_names.end());
const Words weight_names{"lattice", "value", "gradient"};
const Words tension_names{"viscous", "limit"};
const Words scheme_names{"slagflow", "paper"};
const Words operator_names{"radial", "laplacian"};
const Words explicit_names{"old_velocity", "predicted"};
const Words stepping_names{"implicit", "explicit"};
const Words yield_names{"regularised", "exact"};
const Words solver_names{"multigrid", "conjugate_gradient", "sor", "jacobi"};
const Words loop_names{"batch", "conditional"};
const Words stored_names{"short", "full"};

enum class Scheme { slagflow, paper };

// One word for what the paper has; keys that are given go before it.
void describe_scheme(CaseVisitor& v, NumericsSetup& n) {
  Scheme scheme = Scheme::slagflow;
  v.choice(
      key("scheme",
          "paper: smoothing function and viscous step as the paper has them, kernel = \"lucy\", "
          "viscous_weight = \"gradient\", operator = \"laplacian\", explicit_part = \"predicted\", theta = "
          "0.5, solver = \"sor\", viscosity_correction = 1, and no tension: tension = \"limit\", "
          "tension_limit = 0; keys that are given go before it")
          .shorthand(),
      scheme, scheme_names);
  if (scheme != Scheme::paper) return;
  n.kernel = SmoothingKind::lucy, n.viscous_weight = ViscousWeight::gradient;
  n.tension = TensionModel::limit, n.tension_limit = 0;
  n.viscous_operator = ViscousOperator::laplacian;
  n.explicit_part = ExplicitPart::predicted;
  n.viscosity_correction = 1;
  n.theta = 0.5;
  n.solver = ViscousSolver::sor;
}

void describe_yield(CaseVisitor& v, NumericsSetup& n) {
  v.choice(key("yield",
               "exact: unyielded fluid is rigid, equation (17); for newtonian, bingham, herschel-bulkley, "
               "carreau-yasuda, with operator = \"radial\", theta = 1 and the implicit step"),
           n.yield, yield_names);
  v.integer(key("yield_iterations",
                "of (17), most in a step; from half of them on a step ends where stresses agree to a "
                "thousandth. A step that "
                "has not converged by then is tried again with half the time step; after four halvings the "
                "run ends with "
                "exit status 1 and the reason. summary.json counts such solves, yield_unconverged_solves, "
                "and all retries, "
                "retried_steps"),
            n.yield_iterations, {1, 100000});
  v.number(key("yield_augmentation",
               "a of (17) in ρΔx²/Δt, for speed only; auto: of each particle, τ_B over its shear "
               "rate, between 0.3 and 3 where it flows, up to 100 where it rests")
               .or_word("auto", 0),
           n.yield_augmentation, above(0, ""));
}

// Operator, time integration and yield stress.
void describe_viscous_step(CaseVisitor& v, NumericsSetup& n) {
  v.choice(key("operator", "laplacian: for comparison, see below the equations"), n.viscous_operator,
           operator_names);
  v.choice(key("explicit_part", "what the explicit part of (7) acts on when theta < 1"), n.explicit_part,
           explicit_names);
  v.number(key("viscosity_correction",
               "C of equation (7); auto: from the kernel and the support ratio, equation (16); "
               "1.000 at 2.6. slagflow check shows it")
               .or_word("auto", 0),
           n.viscosity_correction, between(0.5, 2, ""));
  v.choice(key("viscous_step", "explicit: no solve, but the time step of equation (5)"), n.viscous_step,
           stepping_names);
  v.number(
      key("diffusion_number", "d_i of equation (5) for the explicit step; beyond some 0.2 it is unstable"),
      n.diffusion_number, above_to(0, 1, ""));
  v.number(key("theta", "equation (7): 1 backward Euler, 0.5 Crank–Nicolson"), n.theta, between(0.5, 1, ""));
  describe_yield(v, n);
}

void describe_solver(CaseVisitor& v, NumericsSetup& n) {
  v.choice(key("solver",
               "multigrid: conjugate gradients with the diagonal, and from the fifth iteration of a step on "
               "with multigrid over rigid motions of cells"),
           n.solver, solver_names);
  v.choice(key("solver_loop",
               "conditional, with multigrid and conjugate_gradient of a regularised, implicit step: on a GPU "
               "the device "
               "repeats iterations until they end, instead of the host after a look at each batch; the same "
               "result. Not "
               "yet run on a GPU, see there. Refused with CUDA before 12.4, the toolkit or the driver; a CPU "
               "build has "
               "nothing to wait for"),
           n.solver_loop, loop_names);
  v.choice(
      key("weights",
          "how the viscous weights of pairs are kept; short: in 16 bits, to 10⁻⁴ of a row of neighbours, "
          "alike for both of a pair, in half of the memory; full: in the precision of the build"),
      n.weights, stored_names);
  v.number(key("tolerance",
               "the rms velocity error of a solve is below tolerance g Δt, and below 3 % of what viscosity "
               "and walls add in the step, so that they act in thin fluid too"),
           n.tolerance, above(0, ""));
  v.integer(key("max_iterations", "of the solver, in a solve"), n.max_iterations, {1, 100000});
  v.number(key("relaxation", "ω of sor"), n.relaxation, inside(0, 2, ""));
}

void describe_tension(CaseVisitor& v, NumericsSetup& n) {
  v.choice(
      key("tension",
          "what fluid bears below zero pressure; viscous: what its viscous stress can ask for, and what "
          "expands beyond that is void, equation (11); limit: tension_limit everywhere, walls too, while "
          "the density goes on falling, for fluid without a free surface"),
      n.tension, tension_names);
  v.number(
      key("tension_limit",
          "p_t of equation (11): the most tension that the fluid bears, the air's pressure; for less at a "
          "wall see wall"),
      n.tension_limit, at_least(0, "Pa"));
  v.number(
      key("background_pressure",
          "added to the pressure of all fluid at the start; auto: 1 % of ρc₀², and what the jitter will "
          "cost, where fluid of the pressure zero has no free surface, so that it comes under no tension, "
          "which it bears less well; else 0")
          .or_word("auto", -1),
      n.background_pressure, at_least(0, "Pa"));
}

// What keeps particles evenly spread.
void describe_order(CaseVisitor& v, NumericsSetup& n) {
  v.number(
      key("anti_pairing",
          "ε of equation (15); auto: 0.1 where a fluid has surface tension or the kernel is lucy, else 0")
          .or_word("auto", -1),
      n.anti_pairing, between(0, 1, ""));
  v.number(
      key("shifting",
          "A of equation (19): keeps the particles of a fluid that is strained for long evenly spread; free "
          "surfaces, interfaces and the rows next to walls take no part; auto: 1 where the fluid has neither "
          "a free surface at the start nor surface tension and the kernel is not lucy, else 0")
          .or_word("auto", -1),
      n.shifting, between(0, 5, ""));
}

}  // namespace

void describe(CaseVisitor& v, NumericsSetup& n) {
  describe_scheme(v, n);
  v.choice(
      key("kernel",
          "the smoothing function, equation (1); level: without friction of the lattice, for support_ratio "
          "2.4 to 4; lucy: the paper's"),
      n.kernel, kernel_names);
  v.choice(
      key("viscous_weight",
          "w of equation (7); lattice: right on lattices in every direction; value: A W; gradient: -F/r²"),
      n.viscous_weight, weight_names);
  v.number(key("sound_speed", "c₀ of equation (11); auto: see The automatic sound speed").or_word("auto", 0),
           n.sound_speed, between(1e-6, 1e6, "m/s"));
  v.number(key("courant", "equation (13)"), n.courant, above_to(0, 1.2, ""));
  v.number(key("max_time_step", "0: no further limit"), n.max_time_step, at_least(0, "s"));
  v.number(key("density_diffusion",
               "δ of equation (10); above about 0.28/courant it shortens the time step, as the diffusion "
               "would be unstable")
               .by_default("0.1; 0.01 where a fluid has surface tension"),
           n.density_diffusion, between(0, 1, ""));
  describe_tension(v, n);
  describe_order(v, n);
  describe_viscous_step(v, n);
  describe_solver(v, n);
  v.number(key("skin", "of the neighbour list, in support radii: speed only, not the result"), n.skin,
           between(0.02, 0.5, ""));
}

void describe_numerics(CaseVisitor& v, Case& c) {
  // Diffusion of the density undermines the pressure that balances surface tension.
  if (v.takes_defaults() && has_surface_tension(c)) c.numerics.density_diffusion = 0.01;
  v.table(key("numerics", "how it is computed"), [&] { describe(v, c.numerics); });
}

}  // namespace slagflow
