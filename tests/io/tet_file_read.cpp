// Tet files: the same five tets in each format, then truncated and changed files; and the cage made of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include "cage/tet_geometry.hpp"
#include "core/error.hpp"
#include "core/log.hpp"
#include "io/import.hpp"
#include "io/import_files.hpp"

using namespace frond;

namespace tet_file_read_tests {

struct TetFiles : testing::Test {
    void SetUp() override { set_log(nullptr, nullptr); }
};

// A unit cube of five tets; two of them are "leaf", three "stem".
const std::vector<Vec3> NODES = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                 {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
const std::vector<Tet> TETS = {{0, 1, 2, 5}, {0, 2, 3, 7}, {0, 5, 7, 4}, {2, 5, 6, 7}, {0, 2, 5, 7}};

std::string text_of_nodes(int index_base, bool with_index) {
    std::string out;
    for (size_t i = 0; i < NODES.size(); ++i) {
        if (with_index) out += std::to_string(int(i) + index_base) + " ";
        for (int k = 0; k < 3; ++k) out += std::to_string(NODES[i][k]) + " ";
        out += "\n";
    }
    return out;
}

std::string gmsh_2() {
    std::string out =
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n3\n2 9 \"skin\"\n3 1 \"stem\"\n3 2 \"my leaf\"\n"
        "$EndPhysicalNames\n$Nodes\n8\n" +
        text_of_nodes(11, true) + "$EndNodes\n$Elements\n6\n1 2 2 9 1 11 12 13\n";
    for (size_t t = 0; t < TETS.size(); ++t) {
        out += std::to_string(t + 2) + " 4 2 " + (t < 3 ? "1" : "2") + " 7";
        for (int node : TETS[t]) out += " " + std::to_string(node + 11);
        out += "\n";
    }
    return out + "$EndElements\n";
}

std::string gmsh_2_binary() {
    std::string out = "$MeshFormat\n2.2 1 8\n";
    files::put(out, int32_t(1));
    out += "\n$EndMeshFormat\n$PhysicalNames\n2\n3 1 \"stem\"\n3 2 \"my leaf\"\n$EndPhysicalNames\n$Nodes\n8\n";
    for (size_t i = 0; i < NODES.size(); ++i) {
        files::put(out, int32_t(i + 1));
        for (int k = 0; k < 3; ++k) files::put(out, NODES[i][k]);
    }
    out += "\n$EndNodes\n$Elements\n5\n";
    for (size_t t = 0; t < TETS.size(); ++t) {
        if (t == 0 || t == 3)
            for (int value : {4, t == 0 ? 3 : 2, 2}) files::put(out, int32_t(value));
        for (int value : {int(t) + 1, t < 3 ? 1 : 2, 7}) files::put(out, int32_t(value));
        for (int node : TETS[t]) files::put(out, int32_t(node + 1));
    }
    return out + "\n$EndElements\n";
}

std::string gmsh_4(bool is_binary) {
    std::string out = std::string("$MeshFormat\n4.1 ") + (is_binary ? "1" : "0") + " 8\n";
    if (is_binary) {
        files::put(out, int32_t(1));
        out += "\n";
    }
    out += "$EndMeshFormat\n$PhysicalNames\n2\n3 1 \"stem\"\n3 2 \"my leaf\"\n$EndPhysicalNames\n$Entities\n";
    const auto whole = [&](int64_t value) {
        is_binary ? files::put(out, int32_t(value)) : void(out += std::to_string(value) + " ");
    };
    const auto large = [&](int64_t value) {
        is_binary ? files::put(out, value) : void(out += std::to_string(value) + " ");
    };
    const auto real = [&](double value) {
        is_binary ? files::put(out, value) : void(out += std::to_string(value) + " ");
    };
    const auto end = [&] { out += is_binary ? "" : "\n"; };
    for (int count : {0, 0, 0, 2}) large(count);
    end();
    for (int volume : {1, 2}) {
        whole(volume);
        for (int k = 0; k < 6; ++k) real(k);
        large(1);
        whole(volume);
        large(0);
        end();
    }
    out += "\n$EndEntities\n$Nodes\n";
    for (int value : {1, 8, 1, 8}) large(value);
    end();
    for (int value : {3, 1, 0}) whole(value);
    large(8);
    end();
    for (int i = 1; i <= 8; ++i) large(i);
    end();
    for (const Vec3& node : NODES)
        for (int k = 0; k < 3; ++k) real(node[k]);
    out += "\n$EndNodes\n$Elements\n";
    for (int value : {2, 5, 1, 5}) large(value);
    end();
    for (int block : {0, 1}) {
        for (int value : {3, block + 1, 4}) whole(value);
        large(block == 0 ? 3 : 2);
        end();
        for (int t = block == 0 ? 0 : 3; t < (block == 0 ? 3 : 5); ++t) {
            large(t + 1);
            for (int node : TETS[size_t(t)]) large(node + 1);
            end();
        }
    }
    return out + "\n$EndElements\n";
}

template <typename Value>
void put_big(std::string& out, Value value) {
    std::string one;
    files::put(one, value);
    out.append(one.rbegin(), one.rend());
}

std::string vtk(bool is_binary) {
    std::string out = std::string("# vtk DataFile Version 3.0\na cube\n") + (is_binary ? "BINARY" : "ASCII") +
                      "\nDATASET UNSTRUCTURED_GRID\nPOINTS 8 " + (is_binary ? "float" : "double") + "\n";
    if (is_binary)
        for (const Vec3& node : NODES)
            for (int k = 0; k < 3; ++k) put_big(out, float(node[k]));
    else
        out += text_of_nodes(0, false);
    out += "\nCELLS 6 29\n";
    const auto whole = [&](int32_t value) {
        is_binary ? put_big(out, value) : void(out += std::to_string(value) + " ");
    };
    for (int value : {3, 0, 1, 2}) whole(value);
    for (const Tet& tet : TETS) {
        whole(4);
        for (int node : tet) whole(node);
    }
    out += "\nCELL_TYPES 6\n";
    for (int type : {5, 10, 10, 10, 10, 10}) whole(type);
    out += "\nCELL_DATA 6\nSCALARS region int 1\nLOOKUP_TABLE default\n";
    for (int region : {0, 1, 1, 1, 2, 2}) whole(region);
    return out + "\nPOINT_DATA 8\nSCALARS other double\nLOOKUP_TABLE default\n" +
           (is_binary ? std::string(64, '\0') : "0 0 0 0 0 0 0 0\n");
}

std::string vtk_5(bool is_binary) {
    std::string out = std::string("# vtk DataFile Version 5.1\na cube\n") + (is_binary ? "BINARY" : "ASCII") +
                      "\nDATASET UNSTRUCTURED_GRID\nPOINTS 8 double\n";
    const auto large = [&](int64_t value) {
        is_binary ? put_big(out, value) : void(out += std::to_string(value) + " ");
    };
    if (is_binary)
        for (const Vec3& node : NODES)
            for (int k = 0; k < 3; ++k) put_big(out, node[k]);
    else
        out += text_of_nodes(0, false);
    out += "\nMETADATA\nINFORMATION 0\n\nCELLS 6 20\nOFFSETS vtktypeint64\n";
    for (int offset : {0, 4, 8, 12, 16, 20}) large(offset);
    out += "\nCONNECTIVITY vtktypeint64\n";
    for (const Tet& tet : TETS)
        for (int node : tet) large(node);
    out += "\nCELL_TYPES 5\n";
    for (int i = 0; i < 5; ++i) is_binary ? put_big(out, int32_t(10)) : void(out += "10\n");
    out += "\nCELL_DATA 5\nFIELD FieldData 1\nMaterialIds 1 5 int\n";
    for (int region : {1, 1, 1, 2, 2})
        is_binary ? put_big(out, int32_t(region)) : void(out += std::to_string(region) + "\n");
    return out + "\n";
}

void expect_cube(const TetMesh& mesh, const std::vector<std::string>& regions) {
    ASSERT_EQ(mesh.nodes.size(), 8u);
    for (size_t i = 0; i < 8; ++i) EXPECT_LT((mesh.nodes[i] - NODES[i]).norm(), 1e-12);
    EXPECT_EQ(mesh.tets, TETS);
    EXPECT_EQ(mesh.regions, regions);
    EXPECT_EQ(mesh.tet_region, (std::vector<int>{0, 0, 0, 1, 1}));
}

struct Row {
    const char* name;
    std::string bytes;
    std::vector<std::string> regions;
};

std::vector<Row> rows() {
    const std::vector<std::string> named = {"stem", "my leaf"}, numbered = {"region_1", "region_2"};
    return {{"a.msh", gmsh_2(), named},        {"b.msh", gmsh_2_binary(), named}, {"c.msh", gmsh_4(false), named},
            {"d.msh", gmsh_4(true), named},    {"a.vtk", vtk(false), numbered},   {"b.vtk", vtk(true), numbered},
            {"c.vtk", vtk_5(false), numbered}, {"d.vtk", vtk_5(true), numbered}};
}

TetMesh cube() {
    return {NODES, TETS, {0, 0, 0, 1, 1}, {"stem", "leaf"}};
}

TEST_F(TetFiles, EveryFormatReadsTheSameCube) {
    files::Folder folder;
    for (const Row& row : rows()) {
        SCOPED_TRACE(row.name);
        expect_cube(import_tets(folder.write(row.name, row.bytes)), row.regions);
    }
}

TEST_F(TetFiles, AreToldByTheirEnding) {
    EXPECT_TRUE(is_tet_file("a.msh"));
    EXPECT_TRUE(is_tet_file("dir/a.VTK"));
    EXPECT_FALSE(is_tet_file("a.obj"));
    EXPECT_FALSE(is_tet_file(".msh"));
    EXPECT_FALSE(is_tet_file(""));
}

TEST_F(TetFiles, TenNodeTetsGiveTheirCorners) {
    std::string nodes, element = "1 11 2 0 1";
    for (int i = 1; i <= 10; ++i) {
        nodes += std::to_string(i) + " " + std::to_string(i % 3) + " " + std::to_string(i % 2) + " " +
                 std::to_string(i / 4) + "\n";
        element += " " + std::to_string(i);
    }
    files::Folder folder;
    const TetMesh mesh =
        import_tets(folder.write("t10.msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n10\n" + nodes +
                                                "$EndNodes\n$Elements\n1\n" + element + "\n$EndElements\n"));
    ASSERT_EQ(mesh.tets.size(), 1u);
    EXPECT_EQ(mesh.tets[0], (Tet{0, 1, 2, 3}));
}

TEST_F(TetFiles, CutFilesAreRefused) {
    files::Folder folder;
    for (const Row& row : rows())
        for (size_t count = 0; count < row.bytes.size(); count += 7) {
            try {
                const TetMesh mesh = import_tets(folder.write(row.name, row.bytes.substr(0, count)));
                // Only what is not needed can be missing: region numbers, or the end of the last section.
                EXPECT_EQ(mesh.tets.size(), 5u) << row.name << " cut to " << count;
            } catch (const Error& error) {
                EXPECT_EQ(error.code, FROND_RESULT_FILE_FORMAT);
                EXPECT_NE(std::string(error.what()).find(row.name), std::string::npos) << error.what();
            }
        }
}

TEST_F(TetFiles, MutantsNeverCrash) {
    files::Folder folder;
    std::mt19937 random(3);
    for (const Row& row : rows())
        for (int mutant = 0; mutant < 400; ++mutant) {
            std::string bytes = row.bytes;
            for (int i = 0; i <= mutant % 3; ++i) {
                const size_t at = random() % bytes.size();
                if (mutant % 2)
                    bytes[at] = "0123456789-.e$ \n\0\xff"[random() % 18];
                else
                    bytes.erase(at, 1 + random() % 20);
            }
            try {
                Surface surface;
                Cage cage;
                Embedding embedding;
                take_tets(import_tets(folder.write(row.name, bytes)), {}, surface, cage, embedding);
                for (const Tet& tet : cage.tets)
                    for (int node : tet) ASSERT_TRUE(node >= 0 && size_t(node) < cage.nodes.size());
            } catch (const Error& error) {
                EXPECT_TRUE(error.code == FROND_RESULT_FILE_FORMAT || error.code == FROND_RESULT_BAD_GEOMETRY)
                    << error.what();
            }
        }
}

TEST_F(TetFiles, ErrorsNameLineAndCause) {
    files::Folder folder;
    const struct {
        const char *name, *cause;
        std::string bytes;
    } bad[] = {
        {"a.msh", "$MeshFormat", "hello\n"},
        {"b.msh", "line 2: the version is 3", "$MeshFormat\n3 0 8\n$EndMeshFormat\n"},
        {"c.msh", "4000000000 nodes", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4000000000\n1 0 0 0\n"},
        {"d.msh", "line 6: \"null\"", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n1\n1 0 null 0\n$EndNodes\n"},
        {"e.msh", "node 99",
         "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n1\n1 0 0 0\n$EndNodes\n$Elements\n1\n1 4 0 1 1 1 "
         "99\n$EndElements\n"},
        {"f.msh", "no tetrahedra", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"},
        {"g.msh", "empty", ""},
        {"h.msh", "not finite", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n1\n1 0 nan 0\n$EndNodes\n"},
        {"a.vtk", "# vtk DataFile", "<VTKFile>"},
        {"b.vtk", "POLYDATA", "# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\n"},
        {"c.vtk", "point 7",
         "# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 1 float\n0 0 0\nCELLS 1 5\n4 0 0 0 "
         "7\nCELL_TYPES 1\n10\n"},
        {"d.vtk", "-5 points", "# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS -5 float\n"},
    };
    for (const auto& row : bad) try {
            import_tets(folder.write(row.name, row.bytes));
            ADD_FAILURE() << row.name;
        } catch (const Error& error) {
            EXPECT_NE(std::string(error.what()).find(row.cause), std::string::npos) << row.name << ": " << error.what();
            EXPECT_NE(std::string(error.what()).find(row.name), std::string::npos) << error.what();
        }
    EXPECT_THROW(import_tets(folder.path + "/none.msh"), Error);
    EXPECT_THROW(import_tets(folder.path), Error);
}

TEST_F(TetFiles, TakenTetsKeepTheirNodesAndGetTheirBoundary) {
    TetMesh mesh = cube();
    std::swap(mesh.tets[1][0], mesh.tets[1][1]);  // inverted
    Surface surface;
    Cage cage;
    Embedding embedding;
    take_tets(mesh, {}, surface, cage, embedding);
    EXPECT_EQ(cage.nodes, NODES);
    double volume = 0;
    for (const Tet& tet : cage.tets) {
        EXPECT_GT(tet_volume(cage.nodes, tet), 0);
        volume += tet_volume(cage.nodes, tet);
    }
    EXPECT_NEAR(volume, 1, 1e-12);
    EXPECT_EQ(cage.tet_organ, (std::vector<int>{0, 0, 0, 1, 1}));
    EXPECT_EQ(cage.tet_fill, std::vector<double>(5, 1.0));

    // Twelve outer faces, oriented outwards: the divergence theorem gives the same volume.
    ASSERT_EQ(surface.triangles.size(), 12u);
    double enclosed = 0;
    for (const Triangle& t : surface.triangles)
        enclosed += surface.positions[size_t(t[0])].dot(
                        surface.positions[size_t(t[1])].cross(surface.positions[size_t(t[2])])) /
                    6;
    EXPECT_NEAR(enclosed, 1, 1e-12);
    ASSERT_EQ(surface.parts.size(), 2u);
    EXPECT_EQ(surface.parts[1].name, "leaf");

    // Every vertex is attached to its own node.
    for (size_t v = 0; v < surface.positions.size(); ++v) {
        Vec3 bound = Vec3::Zero();
        for (size_t k = 0; k < 4; ++k)
            bound += embedding.weights[v][k] * cage.nodes[size_t(cage.tets[size_t(embedding.tet[v])][k])];
        EXPECT_LT((bound - surface.positions[v]).norm(), 1e-15);
    }
}

TEST_F(TetFiles, TakenTetsAreScaledAndTurnedAsTold) {
    Surface surface;
    Cage cage;
    Embedding embedding;
    take_tets(cube(), {0.1, Vec3::UnitZ()}, surface, cage, embedding);
    EXPECT_LT((cage.nodes[4] - Vec3(0, 0.1, 0)).norm(), 1e-15);
    EXPECT_EQ(surface.up, Vec3::UnitZ());
    EXPECT_EQ(surface.scale, 0.1);
    take_tets(cube(), {}, surface, cage, embedding);
    EXPECT_EQ(cage.nodes, NODES) << "as they are";
}

TEST_F(TetFiles, BadTetsAreNamed) {
    Surface surface;
    Cage cage;
    Embedding embedding;
    const auto error_of = [&](const TetMesh& mesh) -> std::string {
        try {
            take_tets(mesh, {}, surface, cage, embedding);
        } catch (const Error& error) {
            EXPECT_EQ(error.code, FROND_RESULT_BAD_GEOMETRY);
            return error.what();
        }
        return "";
    };
    TetMesh mesh = cube();
    mesh.tets[3] = {0, 1, 2, 3};
    EXPECT_NE(error_of(mesh).find("tet 3"), std::string::npos) << "flat";
    mesh = cube();
    mesh.tets[2][1] = 8;
    EXPECT_NE(error_of(mesh).find("tet 2 refers to node 8"), std::string::npos);
    mesh.tets[2][1] = -1;
    EXPECT_NE(error_of(mesh).find("tet 2"), std::string::npos);
    mesh = cube();
    mesh.nodes[5].y() = std::nan("");
    EXPECT_NE(error_of(mesh).find("node 5"), std::string::npos);
    mesh = cube();
    mesh.tet_region[4] = 2;
    EXPECT_NE(error_of(mesh).find("tet 4"), std::string::npos);
    EXPECT_NE(error_of(TetMesh()), "");
}

TEST_F(TetFiles, LooseNodesAndRepeatedTetsAreDropped) {
    TetMesh mesh = cube();
    mesh.nodes.insert(mesh.nodes.begin(), Vec3(5, 5, 5));
    for (Tet& tet : mesh.tets)
        for (int& node : tet) ++node;
    mesh.tets.push_back({mesh.tets[0][1], mesh.tets[0][0], mesh.tets[0][3], mesh.tets[0][2]});
    mesh.tet_region.push_back(1);
    Surface surface;
    Cage cage;
    Embedding embedding;
    take_tets(mesh, {}, surface, cage, embedding);
    EXPECT_EQ(cage.nodes, NODES);
    EXPECT_EQ(cage.tets.size(), 5u);
    EXPECT_EQ(surface.triangles.size(), 12u);
}

}  // namespace tet_file_read_tests
