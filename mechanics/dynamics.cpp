#include "mechanics/dynamics.h"

#include <arkode/arkode_arkstep.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_nonlinearsolver.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <stdexcept>

#include "mechanics/sdirk.h"

namespace bight {

namespace {

constexpr const char* method = "ARKODE_ESDIRK324L2SA_4_2_3";
/// Newton in a stage stops at this part of the error allowed.
constexpr double newton_share = 0.01;
constexpr int newton_iterations = 8;
/// Where the choice of step lengths begins [D sqrt(rho/E)].
constexpr double first_step = 0.1;
/// Failures of one step before it is given up.
constexpr int most_failures = 30;

/// ARKODE's return values: try a shorter step, or give up.
constexpr int fine = 0, shorter = 1;

/// y = (unknown coordinates, their velocities).
Eigen::Map<Vector> mapped(N_Vector y) { return {N_VGetArrayPointer(y), N_VGetLength_Serial(y)}; }

}  // namespace

struct Dynamics::Package {
  MovingBody body;
  DynamicsOptions options;
  const Unknowns& unknowns;
  int n;        ///< unknowns
  Vector mass;  ///< by unknowns
  Vector x, v;  ///< accepted, by coordinates
  Vector y;     ///< what ARKODE works on
  double time;
  std::string reason;
  SparseCholesky cholesky;
  SymmetricMatrix matrix;
  int analysed_pattern = 0, factorisations = 0, evaluations = 0;
  struct {
    double time = 0;
    Vector x, v;
  } solved;  ///< the newest stage, by coordinates
  Vector gradient;
  double energy = 0;
  bool measured = false;  ///< gradient and energy are those of x

  SUNContext context = nullptr;
  N_Vector vector = nullptr;
  SUNLinearSolver solver = nullptr;
  SUNNonlinearSolver minimiser = nullptr;
  void* arkode = nullptr;

  Package(const MovingBody& body, const DynamicsOptions& options, double time, const Vector& x,
          const Vector& v)
      : body(body),
        options(options),
        unknowns(body.assembler.unknowns()),
        n(unknowns.size()),
        mass(Vector::Zero(n)),
        x(x),
        v(v),
        y(2 * n),
        time(time) {
    for (int c = 0; c < unknowns.coordinates(); ++c) {
      const int i = unknowns.index(c);
      if (i < 0) continue;
      mass[i] += body.mass[c], y[i] = unknowns.sign(c) * x[c], y[n + i] = unknowns.sign(c) * v[c];
    }
    place(time, this->x, this->v);
    solved = {time, this->x, this->v};
    SUNContext_Create(nullptr, &context);
    vector = N_VMake_Serial(2 * n, y.data(), context);
    arkode = ARKStepCreate(nullptr, &rates, time, vector, context);
    if (!vector || !arkode) throw std::bad_alloc();
    ARKStepSetUserData(arkode, this);
    ARKStepSetErrHandlerFn(
        arkode, [](int, const char*, const char*, char*, void*) {}, nullptr);
    ARKStepWFtolerances(arkode, &weights);
    body.minimise ? minimise_stages() : solve_stages();
    ARKStepSetMaxConvFails(arkode, most_failures);
    ARKStepSetMaxErrTestFails(arkode, most_failures);
    if (std::isfinite(options.max_step)) ARKStepSetMaxStep(arkode, options.max_step);
    if (options.first_step > 0) ARKStepSetInitStep(arkode, options.first_step);
  }
  ~Package() {
    ARKStepFree(&arkode);
    if (solver) SUNLinSolFreeEmpty(solver);
    if (minimiser) SUNNonlinSolFreeEmpty(minimiser);
    N_VDestroy(vector);
    SUNContext_Free(&context);
  }

  /// ARKODE's own Newton, with our linear solver.
  void solve_stages() {
    solver = SUNLinSolNewEmpty(context);
    if (!solver) throw std::bad_alloc();
    solver->content = this;
    solver->ops->gettype = [](SUNLinearSolver) { return SUNLINEARSOLVER_MATRIX_EMBEDDED; };
    solver->ops->solve = &solve;
    ARKStepSetLinearSolver(arkode, solver, nullptr);
    ARKStepSetTableName(arkode, method, "ARKODE_ERK_NONE");
    ARKStepSetNonlinConvCoef(arkode, newton_share);
    ARKStepSetMaxNonlinIters(arkode, newton_iterations);
  }
  /// The model's Newton.
  void minimise_stages() {
    minimiser = SUNNonlinSolNewEmpty(context);
    if (!minimiser) throw std::bad_alloc();
    minimiser->content = this;
    minimiser->ops->gettype = [](SUNNonlinearSolver) { return SUNNONLINEARSOLVER_ROOTFIND; };
    minimiser->ops->setsysfn = [](SUNNonlinearSolver, SUNNonlinSolSysFn) -> int {
      return SUN_NLS_SUCCESS;
    };
    minimiser->ops->solve = &minimise;
    ARKStepSetNonlinearSolver(arkode, minimiser);
    const ARKodeButcherTable table = sdirk();
    ARKStepSetTables(arkode, table->q, table->p, table, nullptr);
    ARKodeButcherTable_Free(table);
    ARKStepSetInterpolantType(arkode, ARK_INTERP_LAGRANGE);
    ARKStepSetDeduceImplicitRhs(arkode, SUNTRUE);
    ARKStepSetInitStep(arkode, std::min(first_step, options.max_step));
  }

  /// What is no unknown, where the unknowns and the time put it.
  void place(double t, Vector& at, Vector& velocity) const {
    for (const Turn& turn : unknowns.turns())
      for (int first : turn.carried)
        velocity.segment<3>(first) =
            Unknowns::velocity(turn, at.segment<3>(first)) * velocity[turn.angle];
    if (body.prescribe) body.prescribe(t, at, velocity);
    for (const auto& effect : body.assembler.effects()) effect->settle(at);
  }
  void put(const Eigen::Ref<const Vector>& values, Vector& by_coordinates) const {
    for (int c = 0; c < unknowns.coordinates(); ++c)
      if (unknowns.index(c) >= 0) by_coordinates[c] = unknowns.sign(c) * values[unknowns.index(c)];
  }
  Vector taken(const Vector& by_coordinates) const {
    Vector values(n);
    for (int c = 0; c < unknowns.coordinates(); ++c)
      if (unknowns.index(c) >= 0) values[unknowns.index(c)] = unknowns.sign(c) * by_coordinates[c];
    return values;
  }
  /// Unknowns put into a state; carried points turn with their angles.
  void spread(const Eigen::Ref<const Vector>& values, Vector& at) const {
    if (!unknowns.turns().empty()) {
      Vector turning = Vector::Zero(at.size());
      for (const Turn& turn : unknowns.turns())
        turning[turn.angle] =
            unknowns.sign(turn.angle) * values[unknowns.index(turn.angle)] - at[turn.angle];
      unknowns.advance(at, turning);
    }
    put(values, at);
  }
  Vector state(double t, const Eigen::Ref<const Vector>& values) const {
    Vector at = x, velocity = v;
    spread(values.head(n), at);
    place(t, at, velocity);
    return at;
  }

  /// y' = (v, -alpha v - M^-1 dW/dx).
  static int rates(sunrealtype t, N_Vector values, N_Vector rate, void* data) {
    Package& my = *static_cast<Package*>(data);
    const auto at = mapped(values);
    if (!at.allFinite()) return shorter;
    const Vector x = my.state(t, at);
    if ((x - my.x).cwiseAbs().maxCoeff() > my.options.largest_move) return shorter;
    Vector gradient;
    my.body.assembler.refresh(x);
    if (!std::isfinite(my.body.assembler.assemble(x, Order::gradient, gradient))) return shorter;
    ++my.evaluations;
    my.measured = false;
    auto out = mapped(rate);
    const auto velocity = at.tail(my.n);
    out.head(my.n) = velocity;
    out.tail(my.n) =
        -my.body.damping * velocity - my.unknowns.reduce(x, gradient).cwiseQuotient(my.mass);
    return fine;
  }

  static int weights(N_Vector values, N_Vector weight, void* data) {
    const Package& my = *static_cast<Package*>(data);
    const auto velocity = mapped(values).tail(my.n);
    const double speed =
        std::max(my.options.velocity_scale, my.n ? velocity.cwiseAbs().maxCoeff() : 0.0);
    auto out = mapped(weight);
    out.head(my.n).setConstant(1 / my.options.tolerance);
    out.tail(my.n).setConstant(1 / (my.options.tolerance * speed));
    return fine;
  }

  /// What ARKODE says of the stage that it wants solved.
  struct StageData {
    sunrealtype t = 0, gamma = 0;
    N_Vector predicted, current, rate, constant;
  };
  StageData stage_data() const {
    StageData at;
    void* unused;
    ARKStepGetNonlinearSystemData(arkode, &at.t, &at.predicted, &at.current, &at.rate, &at.gamma,
                                  &at.constant, &unused);
    return at;
  }

  static int solve(SUNLinearSolver solver, SUNMatrix, N_Vector z, N_Vector b, sunrealtype) {
    Package& my = *static_cast<Package*>(solver->content);
    const StageData at = my.stage_data();
    if (!my.factor(at.t, mapped(at.current), at.gamma)) return SUNLS_LUFACT_FAIL;
    const auto right = mapped(b);
    const Vector b_x = right.head(my.n);
    Vector r =
        my.mass.cwiseProduct(right.tail(my.n)) - at.gamma * my.body.assembler.hessian().times(b_x);
    const Vector dv = my.cholesky.solve(r);
    auto out = mapped(z);
    out.tail(my.n) = dv;
    out.head(my.n) = b_x + at.gamma * dv;
    return dv.allFinite() ? SUNLS_SUCCESS : SUNLS_LUFACT_FAIL;
  }

  /// Of the stage's equations z = a + gamma (v, -alpha v - M^-1 dW/dx).
  static int minimise(SUNNonlinearSolver solver, N_Vector, N_Vector correction, N_Vector,
                      sunrealtype, booleantype, void*) {
    Package& my = *static_cast<Package*>(solver->content);
    const StageData at = my.stage_data();
    const Vector a = mapped(at.predicted) + mapped(at.constant);
    const double drag = 1 + at.gamma * my.body.damping;
    Stage stage{at.t, drag / (at.gamma * at.gamma), my.x, my.solved.x,
                (at.t - my.solved.time) * my.solved.v};
    my.put(a.head(my.n) + at.gamma / drag * a.tail(my.n), stage.target);
    my.measured = false;
    const std::optional<Vector> found = my.body.minimise(stage);
    if (!found) return SUN_NLS_CONV_RECVR;
    Vector z(2 * my.n);
    z.head(my.n) = my.taken(*found);
    z.tail(my.n) = (z.head(my.n) - a.head(my.n)) / at.gamma;
    my.solved = {at.t, *found, my.v};
    my.put(z.tail(my.n), my.solved.v);
    my.place(at.t, my.solved.x, my.solved.v);
    mapped(correction) = z - mapped(at.predicted);
    return SUN_NLS_SUCCESS;
  }

  bool factor(double t, const Eigen::Ref<const Vector>& values, double gamma) {
    const Vector at = state(t, values);
    Vector gradient;
    Assembler& assembler = body.assembler;
    assembler.refresh(at);
    if (!std::isfinite(assembler.assemble(at, Order::hessian, gradient))) return false;
    const SymmetricMatrix& K = assembler.hessian();
    if (analysed_pattern != assembler.pattern_version()) {
      cholesky.analyse(K, Ordering::minimum_degree);
      analysed_pattern = assembler.pattern_version();
      matrix = K;
    }
    for (size_t k = 0; k < K.value.size(); ++k) matrix.value[k] = gamma * gamma * K.value[k];
    for (int j = 0; j < n; ++j) matrix.value[K.diagonal(j)] += (1 + gamma * body.damping) * mass[j];
    ++factorisations;
    return cholesky.factor(matrix);
  }

  void measure() {
    if (measured) return;
    body.assembler.refresh(x);
    energy = body.assembler.assemble(x, Order::gradient, gradient);
    measured = true;
  }
};

Dynamics::Dynamics(const MovingBody& body, const DynamicsOptions& options, double time,
                   const Vector& x, const Vector& v)
    : package_(std::make_unique<Package>(body, options, time, x, v)) {}

Dynamics::~Dynamics() = default;

bool Dynamics::step(double last) {
  Package& my = *package_;
  ARKStepSetStopTime(my.arkode, last);
  double t = my.time;
  const int status = ARKStepEvolve(my.arkode, last, my.vector, &t, ARK_ONE_STEP);
  my.measured = false;
  if (status < 0) {
    my.reason = status == ARK_ERR_FAILURE ? "the error allowed cannot be kept"
                : status == ARK_CONV_FAILURE
                    ? "a time step does not converge, however short"
                    : std::string("time integration stopped: ") + ARKStepGetReturnFlagName(status);
    return false;
  }
  my.time = t;
  my.spread(my.y.head(my.n), my.x);
  my.put(my.y.tail(my.n), my.v);
  my.place(t, my.x, my.v);
  my.solved = {t, my.x, my.v};
  return true;
}

void Dynamics::forces_changed() {
  package_->measured = false;
  // Steps whose stages are all implicit know nothing of the forces before.
  if (package_->body.minimise) return;
  ARKStepReset(package_->arkode, package_->time, package_->vector);
}

double Dynamics::time() const { return package_->time; }
double Dynamics::next_step() const {
  double step = 0;
  ARKStepGetCurrentStep(package_->arkode, &step);
  return step;
}
const Vector& Dynamics::x() const { return package_->x; }
const Vector& Dynamics::v() const { return package_->v; }
const std::string& Dynamics::reason() const { return package_->reason; }

const Vector& Dynamics::gradient() {
  package_->measure();
  return package_->gradient;
}
double Dynamics::potential_energy() {
  package_->measure();
  return package_->energy;
}
double Dynamics::kinetic_energy() const {
  const Package& my = *package_;
  return 0.5 * my.v.cwiseAbs2().dot(my.body.mass);
}

int Dynamics::steps() const {
  long count = 0;
  ARKStepGetNumSteps(package_->arkode, &count);
  return static_cast<int>(count);
}
int Dynamics::iterations() const {
  long count = 0;
  ARKStepGetNumNonlinSolvIters(package_->arkode, &count);
  return static_cast<int>(count);
}
int Dynamics::factorisations() const { return package_->factorisations; }

}  // namespace bight
