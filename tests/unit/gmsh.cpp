// SPDX-License-Identifier: BSL-1.0
// Gmsh files: both formats give the same mesh, sides have the body where it belongs, and what is wrong is said, with
// the file and the line.
#include <stickslip/io/gmsh.hpp>
#include <stickslip/mesh/coincident_nodes.hpp>

#include <doctest/doctest.h>

#include <sstream>

namespace {

using namespace stickslip;

// As Gmsh writes them: two cells side by side, the right one clockwise; numbers of nodes with gaps, one node of no
// cell. Its curves: 1 (bottom, against the body), 2 (right), 3 (of no group); its point 1 at the origin.
const std::string head = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
const std::string names = "$PhysicalNames\n2\n1 1 \"bottom\"\n0 5 \"the corner\"\n$EndPhysicalNames\n";
const std::string entities =
    "$Entities\n1 3 1 0\n1 0 0 0 1 5\n1 0 0 0 2 0 0 1 -1 2 1 -2\n2 2 0 0 2 1 0 2 1 8 0\n3 0 0 0 0 1 0 0 0\n1 0 0 0 2 1 "
    "0 1 3 0\n$EndEntities\n";
const std::string nodes =
    "$Nodes\n2 7 1 40\n0 1 0 1\n10\n0 0 0\n2 1 1 6\n20\n30\n11\n21\n31\n40\n1 0 0 .5 .5\n2 0 0 .5 .5\n0 1 0 .5 .5\n1 1 "
    "0 .5 .5\n2 1 0 .5 .5\n9 9 9 .5 .5\n$EndNodes\n";
const std::string elements =
    "$Elements\n5 7 1 7\n0 1 15 1\n1 10\n1 1 1 2\n2 20 10\n3 20 30\n1 2 1 1\n4 30 31\n1 3 1 1\n5 11 10\n2 1 3 2\n6 10 "
    "20 21 11\n7 20 21 31 30\n$EndElements\n";
const std::string plate = head + names + entities + nodes + elements;

const std::string plate_v2 =
    "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n" + names +
    "$Nodes\n7\n10 0 0 0\n20 1 0 0\n30 2 0 0\n11 0 1 0\n21 1 1 0\n31 2 1 0\n40 9 9 9\n$EndNodes\n$Elements\n8\n1 15 2 "
    "5 1 10\n2 1 2 -1 1 20 10\n3 1 2 1 1 20 30\n4 1 2 1 2 30 31\n5 1 2 8 2 30 31\n6 1 2 0 3 11 10\n7 3 2 3 1 10 20 21 "
    "11\n8 3 2 3 1 20 21 31 30\n$EndElements\n";

// Two cubes, one on the other; the upper one is mirrored.
const std::string tower =
    "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n2 1 \"top\"\n1 1 "
    "\"edge\"\n$EndPhysicalNames\n$Entities\n0 1 2 1\n1 0 0 0 1 0 0 1 1 0\n1 0 0 2 1 1 2 1 1 0\n2 0 0 0 1 0 1 1 9 0\n1 "
    "0 0 0 1 1 2 0 0\n$EndEntities\n$Nodes\n1 12 1 12\n3 1 0 12\n1\n2\n3\n4\n5\n6\n7\n8\n9\n10\n11\n12\n0 0 0\n1 0 "
    "0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n0 0 2\n1 0 2\n1 1 2\n0 1 2\n$EndNodes\n$Elements\n4 5 1 5\n1 1 1 "
    "1\n1 1 2\n2 1 3 1\n2 9 12 11 10\n2 2 3 1\n3 1 2 6 5\n3 1 5 2\n4 1 2 3 4 5 6 7 8\n5 9 10 11 12 5 6 7 "
    "8\n$EndElements\n";

template <int dim>
auto read(const std::string& text) {
  std::istringstream in(text);
  return io::read_gmsh<dim>(in, "a.msh");
}

template <int dim = 2>
std::string complaint(const std::string& text) {
  try {
    (void)read<dim>(text);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "none";
}

std::string with(std::string text, const std::string& old, const std::string& fresh) {
  const std::size_t at = text.find(old);
  REQUIRE(at != text.npos);
  return text.replace(at, old.size(), fresh);
}

TEST_CASE("a plane Gmsh mesh is read in both formats") {
  for (const std::string& text :
       {plate, plate_v2, with(plate, "$PhysicalNames", "$Comments\nfree $ text\n$EndComments\n$PhysicalNames")}) {
    const Mesh<2, 4> m = read<2>(text);
    REQUIRE(m.node_count() == 6);  // in the order of the file
    CHECK(m.nodes[0] == Vec<Real, 2>(0, 0));
    CHECK(m.nodes[2] == Vec<Real, 2>(2, 0));
    CHECK(m.nodes[5] == Vec<Real, 2>(2, 1));
    REQUIRE(m.cell_count() == 2);
    CHECK(m.cells[0] == std::array<Index, 4>{0, 1, 4, 3});
    CHECK(m.cells[1] == std::array<Index, 4>{1, 2, 5, 4});  // turned
    REQUIRE(m.sides.size() == 3);
    using Facets = std::vector<std::array<Index, 2>>;
    CHECK(m.side("bottom").facets == Facets{{0, 1}, {1, 2}, {2, 5}});
    CHECK(m.side("bottom").nodes == std::vector<Index>{0, 1, 2, 5});
    CHECK(m.side("curve 8").facets == Facets{{2, 5}});
    CHECK(m.side("the corner").facets.empty());
    CHECK(m.side("the corner").nodes == std::vector<Index>{0});
  }
}

TEST_CASE("a spatial Gmsh mesh is read with positive cells and outward facets") {
  const Mesh<3, 8> m = read<3>(tower);
  REQUIRE(m.cell_count() == 2);
  CHECK(m.cells[0] == std::array<Index, 8>{0, 1, 2, 3, 4, 5, 6, 7});
  CHECK(m.cells[1] == std::array<Index, 8>{4, 5, 6, 7, 8, 9, 10, 11});  // turned
  // Seen from outside the facets run counter-clockwise, whatever the file has.
  CHECK(m.side("top").facets == std::vector<std::array<Index, 4>>{{8, 9, 10, 11}});
  CHECK(m.side("surface 9").facets == std::vector<std::array<Index, 4>>{{0, 1, 5, 4}});
  CHECK(m.side("edge").facets.empty());
  CHECK(m.side("edge").nodes == std::vector<Index>{0, 1});
}

TEST_CASE("all six faces of a Gmsh hexahedron are read with outward normals") {
  for (int face = 0; face < 6; ++face) {
    const std::array<std::string, 6> corners{"1 2 3 4", "5 6 7 8", "1 2 6 5", "2 3 7 6", "3 4 8 7", "4 1 5 8"};
    const auto m = read<3>(
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n8\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 0 0 1\n6 1 0 1\n7 1 1 "
        "1\n8 0 1 1\n$EndNodes\n$Elements\n2\n1 3 1 6 " +
        corners[static_cast<std::size_t>(face)] + "\n2 5 1 1 1 2 3 4 5 6 7 8\n$EndElements\n");
    const auto& facet = m.side("surface 6").facets.at(0);
    const auto at = [&](std::size_t k) -> const Vec<Real, 3>& { return m.nodes[static_cast<std::size_t>(facet[k])]; };
    const Vec<Real, 3> a = at(1) - at(0), b = at(2) - at(0), out = (at(0) + at(2)) / 2 - Vec<Real, 3>(0.5, 0.5, 0.5);
    const Vec<Real, 3> normal(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]);
    CHECK(normal.dot(out) > 0);
  }
}

TEST_CASE("wrong Gmsh files are refused with file and line") {
  struct Wrong {
    std::string text, sentence;
  };
  for (const auto& [text, sentence] : std::vector<Wrong>{
           {"", "a.msh, line 1: the file ends where a Gmsh file has \"$MeshFormat\""},
           {"solid a\n", "a.msh, line 1: found \"solid\" where a section, such as \"$Nodes\", should stand"},
           {nodes, "a.msh, line 1: found \"$Nodes\" where a Gmsh file has \"$MeshFormat\""},
           {with(plate, "4.1", "4.0"),
            "a.msh, line 2: this is Gmsh's format \"4.0\"; 4.1 and 2.2 can be read (in Gmsh: Mesh.MshFileVersion)"},
           {with(plate, "4.1 0", "4.1 1"),
            "a.msh, line 2: the file is binary; save it as ASCII (in Gmsh: Mesh.Binary = 0)"},
           {with(plate, "$EndMeshFormat", "$EndMeshform"),
            "a.msh, line 3: found \"$EndMeshform\" where \"$EndMeshFormat\" should stand"},
           {head + head, "a.msh, line 5: the section $MeshFormat is there twice"},
           {plate + "$Periodic\n1\n", "a.msh, line 51: the section $Periodic has no end"},
           {with(plate, "\"bottom\"", "bottom"), "a.msh, line 6: the name of a group must stand in quotation marks"},
           {with(plate, "0 5 \"the corner\"", "1 8 \"bottom\""), "a.msh, line 44: two groups are called \"bottom\""},
           {with(plate, "0 1 5", "0 100 5"),
            "a.msh, line 11: an entity belongs to 100 groups, more than the 32 that can be read"},
           {with(plate, "2 7 1 40", "2 8 1 40"), "a.msh, line 34: the blocks have 7 nodes, the section claims 8"},
           {with(plate, "5 7 1 7", "5 9 1 7"), "a.msh, line 49: the blocks have 7 elements, the section claims 9"},
           {with(plate, "1 0 0 .5", "1 nan 0 .5"), "a.msh, line 29: the number \"nan\" is not finite"},
           {with(plate, "1 0 0 .5", "1 1e999 0 .5"), "a.msh, line 29: the number \"1e999\" is out of range"},
           {with(plate, "1 0 0 .5", "1 0,5 0 .5"), "a.msh, line 29: found \"0,5\" where a coordinate should stand"},
           {with(plate, "\n40\n", "\n31\n"), "a.msh, line 34: there are two nodes 31"},
           {with(plate, "1 1 0 .5", "1 1 1 .5"),
            "a.msh, line 32: node 21 lies outside the plane of node 10; a plane mesh has one z"},
           {with(plate, "6 10 20 21 11", "6 10 20 22 11"), "a.msh, line 48: there is no node 22"},
           {with(plate, "6 10 20 21 11", "6 10 20 21 10"), "a.msh, line 48: the cell names node 10 twice"},
           {with(plate, "6 10 20 21 11", "6 10 20 11 21"),
            "a.msh, line 48: the cell is folded, flat or beyond all size: the Jacobian of a quadrilateral must have "
            "one sign at all quadrature points"},
           {with(plate, "7 20 21 31 30", "7 10 21 20 11"),
            "a.msh, line 49: the cell is folded, flat or beyond all size: the Jacobian of a quadrilateral must have "
            "one sign at all quadrature points"},
           {with(plate, "7 20 21 31 30", "7 10 20 31 21"),
            "a.msh, line 49: the cell and that of line 48 lie on the same side of their common edge"},
           {with(with(plate, "2 1 3 2", "2 1 2 2"), "7 20 21 31 30", "7 20 21 31"),
            "a.msh, line 49: found \"31\" where \"$EndElements\" should stand"},
           {with(plate, "2 1 3 2", "3 1 3 2"), "a.msh, line 47: a quadrilateral cannot have dimension 3"},
           {with(plate, "2 1 3 2", "2 1 16 2"),
            "a.msh, line 47: elements of type 16 cannot be read, only those of first order (in Gmsh: Mesh.ElementOrder "
            "= 1)"},
           {with(plate_v2, "8 3 2 3 1 20 21 31 30", "8 2 2 3 1 20 21 31"),
            "a.msh, line 28: a triangle; all cells must be quadrilaterals (in Gmsh: Mesh.RecombineAll = 1)"},
           {with(plate, "4 30 31", "4 21 20"),
            "a.msh, line 44: the edge of the group \"bottom\" lies inside the body; sides are on its boundary"},
           {with(plate, "4 30 31", "4 30 11"), "a.msh, line 44: the edge of the group \"bottom\" belongs to no cell"},
           {with(plate, "4 30 31", "4 30 40"), "a.msh, line 44: node 40 of the group \"bottom\" belongs to no cell"},
           {with(plate, "4 30 31", "4 30 20"), "a.msh, line 44: the edge of the group \"bottom\" is there twice"},
       }) {
    CHECK(complaint(text) == sentence);
  }
  CHECK(complaint(
            "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n8\n1 0 0 0\n2 0 1 0\n3 -1 0 0\n4 -1 1 0\n5 1 0 0\n6 1 1 0\n"
            "7 2 0 0\n8 2 1 0\n$EndNodes\n$Elements\n3\n1 3 0 3 1 2 4\n2 3 0 1 5 6 2\n3 3 0 1 7 8 2\n$EndElements\n") ==
        "a.msh, line 19: the cell is the third at one edge, see line 18");
  CHECK(complaint(tower) == "a.msh, line 53: a hexahedron has no place in a mesh in the plane; read it in space");
  CHECK(complaint<3>(plate) ==
        "a.msh: there are no hexahedra; Gmsh saves what belongs to a physical group, or all with Mesh.SaveAll = 1");
}

TEST_CASE("a truncated Gmsh file is refused in one sentence") {
  for (const std::string* text : {&plate, &plate_v2}) {
    const std::size_t last = text->rfind("$EndElements") + std::string("$EndElements").size();
    for (std::size_t n = 0; n < last; ++n) {
      const std::string what = complaint(text->substr(0, n));
      CHECK(what.starts_with("a.msh"));
      CHECK(what.find('\n') == what.npos);
    }
    CHECK(complaint(text->substr(0, last)) == "none");
  }
}

TEST_CASE("false counts in a Gmsh file cost no memory") {
  const std::string most = "9223372036854775807";
  for (const std::string& text :
       {with(plate, "$Nodes\n2 7", "$Nodes\n" + most + " " + most), with(plate, "2 1 1 6", "2 1 1 " + most),
        with(plate, "$Elements\n5 7", "$Elements\n" + most + " " + most),
        with(plate, "2 1 3 2\n", "2 1 3 " + most + "\n"), with(plate, "$Entities\n1 3 1 0", "$Entities\n1 3 1 " + most),
        with(plate, "0 0 0\n1 0 0", "0 0 " + most + "\n1 0 0"),
        with(plate, "$PhysicalNames\n2", "$PhysicalNames\n" + most), with(plate_v2, "$Nodes\n7", "$Nodes\n" + most),
        with(plate_v2, "$Elements\n8", "$Elements\n" + most), with(plate_v2, "8 3 2 3", "8 3 " + most + " 3")})
    CHECK(complaint(text).find("should stand") != std::string::npos);
  CHECK(complaint(with(plate, "$Nodes\n2 7", "$Nodes\n9223372036854775808 7")) ==
        "a.msh, line 18: the number \"9223372036854775808\" is out of range");
}

// What Gmsh makes of the plate when it is parted in two between its cells: the curves of the outline lie in entities of
// their own, which repeat the groups of their parents, and there are new ones on the border, which repeat those of the
// surface.
const std::string parted_entities =
    "$Entities\n1 3 1 0\n1 0 0 0 1 5\n1 0 0 0 2 0 0 1 -1 2 1 -2\n2 2 0 0 2 1 0 2 1 8 0\n3 0 0 0 0 1 0 0 0\n1 0 0 0 2 1 "
    "0 1 3 0\n$EndEntities\n";
std::string parted(const std::string& ghosts) {
  return head + names + parted_entities + "$PartitionedEntities\n2\n" + ghosts +
         "\n2 5 2 0\n"
         "7 0 1 1 1 0 0 0 1 5\n8 1 1 2 1 2 1 0 0 1 1\n"  // a corner, and one on the bottom that the border ends at
         "11 1 1 1 1 0 0 0 1 0 0 1 -1 2 7 -8\n12 1 1 1 2 1 0 0 2 0 0 1 -1 2 8 -8\n13 1 2 1 2 2 0 0 2 1 0 2 1 8 0\n"
         "14 1 3 1 1 0 0 0 0 1 0 0 0\n15 2 1 2 1 2 1 0 0 1 1 0 1 3 2 8 -8\n"
         "21 2 1 1 1 0 0 0 1 1 0 1 3 0\n22 2 1 1 2 1 0 0 2 1 0 1 3 0\n$EndPartitionedEntities\n" +
         "$Nodes\n2 7 1 40\n0 7 0 1\n10\n0 0 0\n2 21 1 6\n20\n30\n11\n21\n31\n40\n1 0 0 .5 .5\n2 0 0 .5 .5\n0 1 0 .5 "
         ".5\n1 1 0 .5 .5\n2 1 0 .5 .5\n9 9 9 .5 .5\n$EndNodes\n$GhostElements\n1\n6 1 1 2\n$EndGhostElements\n"
         "$Elements\n9 9 1 9\n0 7 15 1\n1 10\n0 8 15 1\n8 20\n1 11 1 1\n2 20 10\n1 12 1 1\n3 20 30\n1 13 1 1\n4 30 "
         "31\n1 14 1 1\n5 11 10\n1 15 1 1\n9 20 21\n2 21 3 1\n6 10 20 21 11\n2 22 3 1\n7 20 21 31 30\n$EndElements\n";
}

TEST_CASE("a partitioned Gmsh mesh is read as the whole one, with or without ghost cells") {
  const Mesh<2, 4> whole = read<2>(plate);
  for (const std::string ghosts : {"0", "2\n5 1\n6 2"}) {
    const Mesh<2, 4> m = read<2>(parted(ghosts));
    CHECK(m.nodes == whole.nodes);
    CHECK(m.cells == whole.cells);
    REQUIRE(m.sides.size() == whole.sides.size());
    for (const auto& side : whole.sides) {
      INFO(side.first);
      CHECK(m.side(side.first).facets == side.second.facets);
      CHECK(m.side(side.first).nodes == side.second.nodes);
    }
  }
  // Format 2.2 tells of partitions behind the entity.
  std::string v2 = plate_v2;
  for (const char* line : {"7 3 2 3 1 ", "8 3 2 3 1 "}) v2 = with(v2, line, std::string(line, 4) + "5 3 1 2 1 -2 ");
  CHECK(read<2>(v2).cells == whole.cells);
  CHECK(read<2>(v2).side("bottom").facets == whole.side("bottom").facets);
}

TEST_CASE("a side that a Gmsh file loses is refused by name") {
  CHECK(
      complaint(with(plate, "\"bottom\"", "\"bottom\"\n1 6 \"top\"")
                    .replace(plate.find("$PhysicalNames\n2"), 16, "$PhysicalNames\n3")) ==
      "a.msh: the group \"top\" has a name but no elements; format 2.2 loses groups with Mesh.SaveAll = 1, and a mesh "
      "that is saved in pieces has in each file some");
  // An entity that the file does not list.
  CHECK(complaint(with(plate, "1 3 1 1\n5 11 10", "1 4 1 1\n5 11 10")) ==
        "a.msh, line 46: a line of the curve 4, which the file does not list, so that its groups are lost");
}

TEST_CASE("parameters of Gmsh nodes are skipped") {
  const std::string parametric = with(with(plate_v2, "$Nodes", "$ParametricNodes"), "$EndNodes", "$EndParametricNodes");
  std::string text = parametric;
  for (const auto& [old, fresh] :
       std::vector<std::pair<std::string, std::string>>{{"10 0 0 0", "10 0 0 0 0 1"},
                                                        {"20 1 0 0", "20 1 0 0 1 1 0.5"},
                                                        {"30 2 0 0", "30 2 0 0 0 2"},
                                                        {"11 0 1 0", "11 0 1 0 2 1 0 -1e-3"},
                                                        {"21 1 1 0", "21 1 1 0 2 1 0.5 1"},
                                                        {"31 2 1 0", "31 2 1 0 1 2 1"},
                                                        {"40 9 9 9", "40 9 9 9 3 1"}})  // volumes have no parameters
    text = with(text, "\n" + old + "\n", "\n" + fresh + "\n");
  CHECK(read<2>(text).nodes == read<2>(plate_v2).nodes);
  CHECK(read<2>(text).cells == read<2>(plate_v2).cells);
  CHECK(complaint(parametric) == "a.msh, line 12: the number \"20\" is out of range");
  CHECK(complaint(with(plate_v2, "$Elements", "$ParametricNodes\n0\n$EndParametricNodes\n$Elements")) ==
        "a.msh, line 20: the section $ParametricNodes is there twice");
  // Older programs call the section so in format 4.1 too.
  CHECK(read<2>(with(with(plate, "$Nodes", "$ParametricNodes"), "$EndNodes", "$EndParametricNodes")).nodes ==
        read<2>(plate).nodes);
}

TEST_CASE("a Gmsh cell of two groups is one cell") {
  // In format 4.1 the entity has both, in format 2.2 its cells are there twice, one of them perhaps turned.
  const std::string both = with(plate, "0 1 3 0\n$EndEntities", "0 2 3 4 0\n$EndEntities");
  const std::string twice = with(with(plate_v2, "$Elements\n8", "$Elements\n10"), "8 3 2 3 1 20 21 31 30\n",
                                 "8 3 2 4 1 10 20 21 11\n9 3 2 3 1 20 21 31 30\n10 3 2 4 1 20 30 31 21\n");
  for (const std::string* text : {&both, &twice}) {
    CHECK(read<2>(*text).cells == read<2>(plate).cells);
    CHECK(read<2>(*text).side("bottom").facets == read<2>(plate).side("bottom").facets);
  }
  // The same group, or another entity: the cell is there twice.
  CHECK(complaint(with(twice, "8 3 2 4 1", "8 3 2 3 1")) ==
        "a.msh, line 28: the cell and that of line 27 lie on the same side of their common edge");
  CHECK(complaint(with(twice, "8 3 2 4 1", "8 3 2 4 2")) ==
        "a.msh, line 28: the cell and that of line 27 lie on the same side of their common edge");
}

TEST_CASE("a UTF-8 byte order mark before a Gmsh file is skipped") {
  CHECK(read<2>("\xef\xbb\xbf" + plate).cells == read<2>(plate).cells);
}

TEST_CASE("coincident nodes are found") {
  Mesh<2, 4> blocks = read<2>(plate);
  CHECK(mesh::coincident_nodes(blocks).nodes == 0);
  // The right cell comes apart: nodes of its own on the common edge.
  for (const Index n : {1, 4}) {
    blocks.nodes.push_back(blocks.nodes[static_cast<std::size_t>(n)] + Vec<Real, 2>(1e-10, -1e-10));
    for (Index& of_cell : blocks.cells[1])
      if (of_cell == n) of_cell = blocks.node_count() - 1;
  }
  CHECK(mesh::coincident_nodes(blocks).nodes == 2);
  const auto first = mesh::coincident_nodes(blocks).first;
  CHECK((first == std::array<Index, 2>{1, 6} || first == std::array<Index, 2>{4, 7}));
  blocks.nodes[6][0] += 1e-8;
  CHECK(mesh::coincident_nodes(blocks).nodes == 1);
  for (const int n : {1, 3, 17}) {
    CHECK(mesh::coincident_nodes(mesh::rectangle({.size = {1, 1}, .cells = {n, 2 * n}})).nodes == 0);
    CHECK(mesh::coincident_nodes(mesh::box({.origin = {1e6, 0, 0}, .size = {1, 2, 3}, .cells = {n, n, n}})).nodes == 0);
  }
}

TEST_CASE("a Gmsh file that cannot be opened is named") {
  CHECK_THROWS_WITH_AS((void)io::read_gmsh<2>("/no/such/file.msh"),
                       "cannot read /no/such/file.msh: No such file or directory", std::runtime_error);
  CHECK_THROWS_WITH_AS((void)io::read_gmsh<2>("/dev/null"), "cannot read /dev/null: it is no regular file",
                       std::runtime_error);
}

}  // namespace
