#include <cmath>

#include "program.h"

namespace {

using testing_support::Outcome;
using testing_support::ProgramTest;

class EnergyCommand : public ProgramTest {};

TEST_F(EnergyCommand, GivesTheSameForAllFormsOfAShell) {
  succeed("shape sphere s.off --edge 0.3");
  succeed("dual s.off s.extxyz --digits 17");
  succeed("dual s.off s.data --digits 17 --atom-style molecular");
  const double mesh = succeed("energy s.off --json").json()["energy"];
  const double xyz = succeed("energy s.extxyz --json").json()["energy"];
  const double data = succeed("energy s.data --json").json()["energy"];
  const double tolerance = 1e-9 * std::abs(mesh);  // sums in another order, and a periodic box
  EXPECT_NEAR(xyz, mesh, tolerance);
  EXPECT_NEAR(data, mesh, tolerance);
}

TEST_F(EnergyCommand, WritesEnergiesAndForces) {
  succeed("shape sphere s.off --edge 0.3");
  const auto result = succeed("energy s.off --forces -o out.extxyz --json").json();
  const std::string text = content("out.extxyz");
  EXPECT_NE(text.find("rings:I:3:energies:R:1:forces:R:3"), std::string::npos);
  EXPECT_NE(text.find(" energy=-"), std::string::npos);
  double sum = 0.0;
  for (const double energy : result["energies"]) sum += energy;
  EXPECT_NEAR(sum, result["energy"].get<double>(), 1e-9);
  EXPECT_EQ(result["forces"].size(), result["atoms"].get<std::size_t>());
  EXPECT_EQ(result["worst"][0]["energy"], result["highest"]);

  succeed("energy out.extxyz --potential lj -o again.extxyz");
  EXPECT_EQ(content("again.extxyz").find("forces"), std::string::npos);
}

TEST_F(EnergyCommand, ReadsAtomsWhoseFormatIsNamed) {
  succeed("shape sphere s.off --edge 0.3");
  succeed("dual s.off s.extxyz --digits 17");
  succeed("dual s.off data.sphere --digits 17");
  const double energy = succeed("energy s.extxyz --json").json()["energy"];
  const double tolerance = 1e-9 * std::abs(energy);
  EXPECT_NEAR(succeed("energy data.sphere --json").json()["energy"], energy, tolerance);
  write("plain", content("s.extxyz"));
  EXPECT_NEAR(succeed("energy plain --format extxyz --json").json()["energy"], energy, tolerance);
  const Outcome piped =
      shell("{ cat s.extxyz | " TRIVALENT_PROGRAM " energy - --format extxyz --json; }");
  ASSERT_EQ(piped.exit_code, 0) << piped.err;
  EXPECT_NEAR(piped.json()["energy"], energy, tolerance);
  expect_failure(2, "--format does", "energy -");
  expect_failure(2, "known are extxyz, lammps-data", "energy plain --format docx");
  expect_failure(2, "mean nothing for a mesh", "energy s.off --frame 2");
}

TEST_F(EnergyCommand, TakesElementsAndStylesFromTheCommandLine) {
  write("types.xyz", "2\nAtoms. Timestep: 0\n2 0 0 0\n1 0 0 1.1\n");
  expect_failure(1, "--elements", "energy types.xyz");
  EXPECT_EQ(succeed("energy types.xyz --elements H C --json").json()["energy"],
            succeed("energy types.xyz --json --elements H,C").json()["energy"]);
  expect_failure(2, "'Si' is not C or H", "energy types.xyz --elements H Si");
  write("open.data",
        "t\n\n2 atoms\n2 atom types\n0 9 xlo xhi\n0 9 ylo yhi\n0 9 zlo zhi\n\nMasses\n\n1 12.011\n"
        "2 1.008\n\nAtoms\n\n1 1 2 4 4 4\n2 2 1 4 4 5.1\n");
  expect_failure(1, "line 16: atom_style may be molecular or charge", "energy open.data");
  succeed("energy open.data --atom-style charge");
  expect_failure(2, "--atom-style is", "energy open.data --atom-style sphere");
}

TEST_F(EnergyCommand, ReadsTheLastOrTheNamedStructure) {
  succeed("shape sphere s.off --edge 0.3");
  succeed("relax s.off -o relaxed.extxyz --trajectory way.extxyz --every 1 --digits 17");
  const Outcome last = succeed("energy way.extxyz --json");
  EXPECT_NE(last.err.find("the last is read"), std::string::npos);
  const double first = succeed("energy way.extxyz --frame 1 --json").json()["energy"];
  EXPECT_LT(last.json()["energy"].get<double>(), first);
}

TEST_F(EnergyCommand, KeepsOnlyBondsThatAreKnown) {
  succeed("shape sphere s.off --edge 0.3");
  succeed("energy s.off -o known.extxyz");
  EXPECT_NE(content("known.extxyz").find("bonded_atoms:I:3"), std::string::npos);
  write("c2.xyz", "2\n\nC 0 0 0\nC 1.4 0 0\n");
  const auto found = succeed("energy c2.xyz -o found.extxyz --json").json();
  EXPECT_EQ(found["bonds_from"], "distance");
  EXPECT_EQ(content("found.extxyz").find("bonded_atoms"), std::string::npos);
}

TEST_F(EnergyCommand, WritesAnEnergyMap) {
  succeed("shape sphere s.off --edge 0.3");
  succeed("energy s.off -o map.ply");
  EXPECT_NE(content("map.ply").find("property double energy\n"), std::string::npos);
}

#ifdef TRIVALENT_VTK
TEST_F(EnergyCommand, WritesMapsThatVtkReads) {
  succeed("shape sphere s.off --edge 0.3");
  succeed("dual s.off s.extxyz");
  for (const std::string input : {"s.off", "s.extxyz"}) {
    write("result.json", succeed("energy " + input + " -o map.vtp --json").out);
    const Outcome vtk = shell(TRIVALENT_VTK " map.vtp result.json");
    EXPECT_EQ(vtk.exit_code, 0) << input << '\n' << vtk.err;
  }
}
#endif

TEST_F(EnergyCommand, FindsTheRingsOfAtomsFromAFile) {
  succeed("shape sphere s.off --edge 0.3");
  const auto mesh = succeed("energy s.off -o mesh.ply --json").json();
  succeed("dual s.off s.data --digits 17");
  const auto atoms = succeed("energy s.data -o atoms.ply --periodic none --json").json();
  EXPECT_EQ(atoms["ring_sizes"], mesh["ring_sizes"]);
  EXPECT_EQ(atoms["coordinations"], mesh["coordinations"]);
  const auto faces = [&](const std::string& text) {
    const std::size_t at = text.find("element face ");
    return text.substr(at, text.find('\n', at) - at);
  };
  EXPECT_NE(faces(content("atoms.ply")), "element face 0");
  EXPECT_EQ(faces(content("atoms.ply")), faces(content("mesh.ply")));
}

TEST_F(EnergyCommand, EvaluatesADimerUnderLennardJones) {
  write("two.xyz", "2\n\nC 0 0 0\nC 4.0 0 0\n");
  const auto result =
      succeed("energy two.xyz --potential lj --lj-epsilon 1 --lj-sigma 3 --json").json();
  const double s6 = std::pow(0.75, 6);
  EXPECT_NEAR(result["energy"].get<double>(), 4.0 * (s6 * s6 - s6), 1e-14);
  EXPECT_FALSE(result.contains("excess_per_atom"));
}

TEST_F(EnergyCommand, FindsGrapheneInAPeriodicBox) {
  const double bond = 1.42;
  const double a = std::sqrt(3.0) * bond;
  write("g.extxyz", "2\nLattice=\"" + std::to_string(a) + " 0 0 " + std::to_string(a / 2) + " " +
                        std::to_string(1.5 * bond) +
                        " 0 0 0 20\" Properties=species:S:1:pos:R:3 pbc=\"T T F\"\nC 0 0 0\nC 0 " +
                        std::to_string(bond) + " 0\n");
  const auto result = succeed("energy g.extxyz --json").json();
  EXPECT_NEAR(result["excess_per_atom"].get<double>(), 0.0, 1e-4);
  const auto cluster = succeed("energy g.extxyz --periodic none --json").json();
  EXPECT_GT(cluster["excess_per_atom"].get<double>(), 1.0);
}

#ifdef TRIVALENT_LMP
TEST_F(EnergyCommand, AgreesWithLammpsOnAirebo) {
  succeed("shape sphere s.off --edge 0.3");
  succeed("dual s.off s.data --digits 17");
  write("in.airebo",
        "units metal\nboundary s s s\natom_style atomic\nread_data s.data\n"
        "pair_style airebo 3.0 1 1\npair_coeff * * CH.airebo C\nfix motion all nve\nrun 0\n"
        "variable energy equal pe\nprint \"energy $(v_energy:%.15g)\"\n");
  const Outcome run = shell(TRIVALENT_LMP " -in in.airebo");
  ASSERT_EQ(run.exit_code, 0) << run.out;
  const double theirs = std::stod(run.out.substr(run.out.find("\nenergy ") + 8));
  const auto result = succeed("energy s.data --potential airebo --periodic none --json").json();
  const double n_atoms = result["atoms"];
  EXPECT_NEAR(result["energy"].get<double>() / n_atoms, theirs / n_atoms, 1e-8);
}
#endif

TEST_F(EnergyCommand, RefusesWhatMakesNoSense) {
  write("two.xyz", "2\n\nC 0 0 0\nC 1.4 0 0\n");
  expect_failure(2, "--potential", "energy two.xyz --potential tersoff");
  expect_failure(2, "--periodic", "energy two.xyz --periodic abc");
  expect_failure(2, "extension", "energy two.xyz -o out.docx");
  expect_failure(2, "--worst", "energy two.xyz --worst -1");
  expect_failure(2, "sigma", "energy two.xyz --potential lj --lj-sigma 0");
  expect_failure(2, "--potential lj", "energy two.xyz --lj-cutoff 5");
  expect_failure(2, "holds atoms", "energy two.xyz --scale 2");
  expect_failure(2, "holds atoms", "energy graphene:nx=1,ny=1 --bond 1.4");
  expect_failure(1, "missing.xyz", "energy missing.xyz");
  write("bad.xyz", "2\n\nC 0 0 0\nSi 1.4 0 0\n");
  expect_failure(1, "line 4", "energy bad.xyz");
  write("same.xyz", "2\n\nC 0 0 0\nC 0 0 0\n");
  expect_failure(1, "on top of each other", "energy same.xyz");
  write("two.pdb", "");
  expect_failure(1, "two.pdb", "energy two.pdb");
}

}  // namespace
