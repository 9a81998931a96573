// What a Newton iteration of the solid costs without contact: straight rods, bent slightly.
// `solid_straight mesh` takes the paper's mesh (108 cells a section, 476 layers) and, where `ccx`
// is installed, CalculiX's C3D8R on the same mesh in the same run; `solid_straight lengths` takes
// rods of 15 D to 270 D with 32 cells a section.

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>

#include "solid3d/material.h"
#include "tests/solid3d/straight_rod.h"

using namespace bight;

namespace {

constexpr double kappa = 2e-3;  ///< of the bent rods [1/D]

/// Of a child process of its own, whose peak of memory nothing before it has raised.
struct Spent {
  double cpu_seconds = 0, peak_MB = 0;
};
Spent in_child(const std::function<void()>& job) {
  std::fflush(stdout);
  const pid_t child = fork();
  if (child == 0) {
    job();
    std::fflush(stdout);
    _exit(0);
  }
  rusage usage{};
  int status = 0;
  wait4(child, &status, 0, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return {seconds(usage.ru_utime) + seconds(usage.ru_stime),
          static_cast<double>(usage.ru_maxrss) / 1024};
}

/// Axial cell length over width for so many layers.
double axial(int cells, double length, int layers) {
  return length / (layers - 1) / solid3d::make_section(cells).cell_width();
}

void ours(int cells, double length, double axial) {
  const Spent spent = in_child([&] {
    const test::RodSolution bent =
        test::bent_rod({.cells = cells, .axial = axial}, length, {kappa, 0, 0});
    std::printf(
        "bight     L0 %6.2f D, %7d unknowns: %d iterations, %6.3f CPU s each, %.2f us an "
        "unknown",
        length, bent.unknowns, bent.newton.factorisations,
        bent.cpu_seconds / bent.newton.factorisations,
        1e6 * bent.cpu_seconds / bent.newton.factorisations / bent.unknowns);
    for (const auto& [phase, seconds] : bent.wall_seconds)
      std::printf(", %s %.2f", phase.c_str(), seconds);
    std::printf(" wall s in all");
  });
  std::printf(", peak %.2f GB\n", spent.peak_MB / 1024);
}

/// The same rod as input of CalculiX (of Abaqus, too): length in D, stress in E.
void write_input(const std::filesystem::path& file, const solid3d::Mesh& mesh, double length) {
  std::ofstream out(file);
  out.precision(12);
  out << "*NODE, NSET=ALL\n";
  for (int n = 0; n < mesh.nodes(); ++n) {
    const Vector3 X = mesh.reference(n);
    out << n + 1 << "," << X.x() << "," << X.y() << "," << X.z() << "\n";
  }
  out << "*ELEMENT, TYPE=C3D8R, ELSET=ROD\n";
  int number = 0;
  for (int k = 0; k + 1 < mesh.layers(); ++k)
    for (const auto& quad : mesh.section.quads) {
      out << ++number;
      for (const int layer : {k, k + 1})
        for (const int point : quad) out << "," << mesh.node(layer, point) + 1;
      out << "\n";
    }
  const solid3d::MaterialParameters material;
  out << "*MATERIAL, NAME=RUBBER\n*HYPERELASTIC, NEO HOOKE\n"
      << 0.5 * material.shear_modulus() << "," << 2 / material.bulk_modulus() << "\n"
      << "*SOLID SECTION, ELSET=ROD, MATERIAL=RUBBER\n"
      << "*STEP, NLGEOM\n*STATIC, DIRECT\n1.,1.\n*BOUNDARY\n";
  for (const int layer : {0, mesh.layers() - 1})
    for (int p = 0; p < mesh.points_per_layer(); ++p) {
      const int n = mesh.node(layer, p);
      const Vector3 X = mesh.reference(n);
      const double a = layer == 0 ? 0 : kappa * length;
      const Vector3 to((1 - std::cos(a)) / kappa + std::cos(a) * X.x(), X.y(),
                       std::sin(a) / kappa - std::sin(a) * X.x());
      for (int c = 0; c < 3; ++c)
        out << n + 1 << "," << c + 1 << "," << c + 1 << "," << to[c] - X[c] << "\n";
    }
  out << "*NODE FILE, FREQUENCY=1000\nU\n*END STEP\n";
}

void calculix(int cells, double length, double axial) {
  if (std::system("command -v ccx >/dev/null") != 0) {
    std::printf("CalculiX  not installed (Debian: calculix-ccx)\n");
    return;
  }
  const auto folder = std::filesystem::temp_directory_path() / ("ccx_" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  const solid3d::Mesh mesh = test::straight_mesh(cells, length, axial);
  write_input(folder / "rod.inp", mesh, length);
  const Spent spent = in_child([&] {
    const std::string folder_name = folder.string();
    if (chdir(folder_name.c_str()) != 0 || !std::freopen("log", "w", stdout)) _exit(1);
    execlp("ccx", "ccx", "rod", nullptr);
    _exit(1);
  });
  int iterations = 0;
  std::ifstream log(folder / "log");
  for (std::string line; std::getline(log, line);)
    iterations += line.find(" iteration ") == 0 ? 1 : 0;
  std::printf(
      "CalculiX  %7d unknowns: %d iterations, %6.3f CPU s each, reading and writing "
      "counted, peak %.2f GB\n",
      3 * (mesh.layers() - 2) * mesh.points_per_layer(), iterations,
      spent.cpu_seconds / std::max(1, iterations), spent.peak_MB / 1024);
  std::filesystem::remove_all(folder);
}

}  // namespace

int main(int count, char** words) {
  const std::string name = count > 1 ? words[1] : "";
  if (name == "mesh") {
    constexpr double length = 350 / 8.3;
    ours(108, length, axial(108, length, 476));
    calculix(108, length, axial(108, length, 476));
  } else if (name == "lengths") {
    for (const double length : {15.0, 42.17, 135.0, 270.0}) ours(32, length, 0.8);
  } else {
    std::printf("solid_straight mesh|lengths\n");
    return 2;
  }
}
