// Converts assimp's scene. In: a tree of nodes with meshes. Out: a surface in world coordinates, one part for each mesh
// of each node (instances become parts of their own). Skinned meshes are posed by their bones.
#include <assimp/scene.h>

#include <cctype>
#include <cmath>
#include <map>
#include <set>

#include "core/elementary.hpp"
#include "core/log.hpp"
#include "importer/importer.hpp"

namespace frond {

using Mat4 = Eigen::Matrix4d;

static constexpr size_t MOST_NODES = 500000, MOST_PARTS = 200000;  // a file with more is damaged

struct SceneNode {
    const aiNode* node;
    Mat4 transform;  // node to world
    int parent;      // index in the list; -1 at the root
};

static Mat4 matrix_of(const aiMatrix4x4& m) {
    Mat4 out;
    out << m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4, m.c1, m.c2, m.c3, m.c4, m.d1, m.d2, m.d3, m.d4;
    return out;
}

// Lists all nodes with their transforms, parents first, without recursion.
static std::vector<SceneNode> list_nodes(const aiScene& scene) {
    std::vector<SceneNode> nodes;
    std::vector<std::pair<const aiNode*, int>> open;
    if (scene.mRootNode) open.push_back({scene.mRootNode, -1});
    while (!open.empty()) {
        const auto [node, parent] = open.back();
        open.pop_back();
        if (nodes.size() >= MOST_NODES) fail(FROND_RESULT_FILE_FORMAT, "the file has more than %zu nodes", MOST_NODES);
        const Mat4 local = matrix_of(node->mTransformation);
        nodes.push_back({node, parent < 0 ? local : Mat4(nodes[size_t(parent)].transform * local), parent});
        const int self = int(nodes.size()) - 1;
        for (unsigned i = node->mNumChildren; i-- > 0;)
            if (node->mChildren[i]) open.push_back({node->mChildren[i], self});
    }
    return nodes;
}

// ---- names ----

// Returns whether a name says nothing about a plant, such as "Object_12".
static bool is_generic(const std::string& name) {
    static const std::set<std::string> WORDS = {"",
                                                "object",
                                                "obj",
                                                "mesh",
                                                "meshes",
                                                "node",
                                                "nodes",
                                                "root",
                                                "rootnode",
                                                "scene",
                                                "group",
                                                "default",
                                                "geometry",
                                                "shape",
                                                "primitive",
                                                "primitives",
                                                "defaultobject",
                                                "polysurface",
                                                "transform",
                                                "null",
                                                "empty",
                                                "sketchfabmodel",
                                                "world",
                                                "gltfscenerootnode",
                                                "model",
                                                "stlascii",
                                                "stlbinary",
                                                "colladaautoname",
                                                "visualscene",
                                                "untitled",
                                                "unnamed"};
    if (name.compare(0, 2, "$C") == 0 || name.compare(0, 1, "<") == 0) return true;
    std::string letters;
    for (char letter : name)
        if (isalpha(uint8_t(letter))) letters += char(tolower(uint8_t(letter)));
    return WORDS.count(letters) > 0;
}

// Returns the nearest meaningful name: the node's, the mesh's, an ancestor's; else the file's.
static std::string name_part(const std::vector<SceneNode>& nodes, int node, const aiMesh& mesh, const MeshFile& file) {
    const std::string own = nodes[size_t(node)].node->mName.C_Str(), mesh_name = mesh.mName.C_Str();
    if (!is_generic(own) && nodes[size_t(node)].parent >= 0) return own;
    if (!is_generic(mesh_name)) return mesh_name;
    for (int at = nodes[size_t(node)].parent; at >= 0; at = nodes[size_t(at)].parent) {
        const std::string name = nodes[size_t(at)].node->mName.C_Str();
        if (nodes[size_t(at)].parent >= 0 && !is_generic(name)) return name;
    }
    if (!own.empty() && nodes[size_t(node)].parent >= 0) return own;
    return file.name.substr(0, file.name.rfind('.'));
}

// Returns a name's level of detail: "Leaf_LOD2" -> 2; -1 if it has none.
static int level_of(const std::string& name) {
    std::string lower;
    for (char letter : name) lower += char(tolower(uint8_t(letter)));
    const size_t at = lower.rfind("lod");
    if (at == std::string::npos || (at > 0 && isalpha(uint8_t(lower[at - 1])))) return -1;
    size_t digit = at + 3;
    while (digit < lower.size() && (lower[digit] == '_' || lower[digit] == ' ' || lower[digit] == '-')) ++digit;
    if (digit >= lower.size() || !isdigit(uint8_t(lower[digit]))) return -1;
    return lower[digit] - '0';
}

// Marks nodes that hold a coarser copy of another node's meshes.
static std::vector<char> find_coarse_copies(const std::vector<SceneNode>& nodes) {
    std::vector<int> level(nodes.size(), -1);
    bool has_finest = false;
    for (size_t i = 0; i < nodes.size(); ++i) {
        level[i] = level_of(nodes[i].node->mName.C_Str());
        if (level[i] < 0 && nodes[i].parent >= 0) level[i] = level[size_t(nodes[i].parent)];
        has_finest = has_finest || (level[i] == 0 && nodes[i].node->mNumMeshes > 0);
    }
    std::vector<char> coarse(nodes.size(), 0);
    for (size_t i = 0; has_finest && i < nodes.size(); ++i) coarse[i] = level[i] > 0;
    return coarse;
}

// ---- meshes ----

static Color color_of(const aiColor4D& color, bool is_linear) {
    const float channels[4] = {color.r, color.g, color.b, color.a};
    Color out;
    for (size_t i = 0; i < 4; ++i) {
        float value = channels[i] >= 0 ? std::min(channels[i], 1.0f) : 0.0f;
        if (is_linear && i < 3) value = srgb_of(value);
        out[i] = uint8_t(std::lround(255 * value));
    }
    return out;
}

static bool is_black(const aiMesh& mesh) {
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
        const aiColor4D& color = mesh.mColors[0][i];
        if (color.r > 0 || color.g > 0 || color.b > 0) return false;
    }
    return true;
}

// Returns whether vertex colours are used. Beside a texture they are masks for wind and shading in FBX and DAE; all
// black is no colour either.
static bool wants_colors(const aiMesh& mesh, const MeshFile& file, const Part& part) {
    const bool is_gltf = file.format == FileFormat::GLTF || file.format == FileFormat::GLB;
    if (!mesh.mColors[0] || is_black(mesh)) return false;
    return is_gltf || part.texture < 0;
}

// Returns the rounding of a mesh's coordinates in single precision, in which it was read [file units].
static double rounding_of(const Corners& corners) {
    constexpr double ROUNDING = 6e-8, LARGEST = 1e18;  // of a coordinate; larger ones are no places
    double far = 0;
    for (const Vec3& place : corners.positions) {
        const double distance = place.cwiseAbs().maxCoeff();
        if (distance < LARGEST) far = std::max(far, distance);
    }
    return ROUNDING * far;
}

// Refuses a surface that lay so far from its origin that rounding has merged its details.
static void check_precision(const Surface& surface, double rounding) {
    constexpr double COARSE = 1e-3, LARGEST = 1e18;  // of the surface's size
    Eigen::AlignedBox3d box;
    for (const Vec3& place : surface.positions)
        if (place.cwiseAbs().maxCoeff() < LARGEST) box.extend(place);
    const double size = box.isEmpty() ? 0 : box.diagonal().norm();
    if (size > 0 && rounding > COARSE * size)
        fail(FROND_RESULT_BAD_GEOMETRY,
             "the plant is %.3g m large and so far from its origin that single precision rounds its places to %.3g m; "
             "move it to the origin and export it again, or as .obj or .ply in double precision",
             size, rounding);
}

static Corners take_corners(const aiMesh& mesh, const MeshFile& file, bool with_colors, size_t& dropped_lines,
                            int& dropped_triangles) {
    const bool is_gltf = file.format == FileFormat::GLTF || file.format == FileFormat::GLB;
    Corners corners;
    const size_t count = mesh.mNumVertices;
    if (!mesh.mVertices || mesh.mNumFaces > unsigned(MAX_TRIANGLES))
        fail(FROND_RESULT_BAD_GEOMETRY, "the file has more than the %d triangles that are allowed; simplify it",
             MAX_TRIANGLES);
    for (size_t i = 0; i < count; ++i) {
        const aiVector3D& at = mesh.mVertices[i];
        corners.positions.push_back(Vec3(double(at.x), double(at.y), double(at.z)));
        // STL has one normal per facet, which adds nothing to the triangle.
        if (mesh.mNormals && file.format != FileFormat::STL)
            corners.normals.push_back(Vec3f(mesh.mNormals[i].x, mesh.mNormals[i].y, mesh.mNormals[i].z));
        // assimp's v = 0 is the bottom row.
        if (mesh.mTextureCoords[0])
            corners.uvs.push_back(Vec2f(mesh.mTextureCoords[0][i].x, 1 - mesh.mTextureCoords[0][i].y));
        if (with_colors) corners.colors.push_back(color_of(mesh.mColors[0][i], is_gltf));
    }
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
        const aiFace& face = mesh.mFaces[f];
        if (face.mNumIndices != 3 || !face.mIndices) {
            ++dropped_lines;
            continue;
        }
        const unsigned* index = face.mIndices;
        if (index[0] >= count || index[1] >= count || index[2] >= count) {
            ++dropped_triangles;
            continue;
        }
        corners.triangles.push_back({int(index[0]), int(index[1]), int(index[2])});
    }
    return corners;
}

// Returns the vertex-to-world matrix of each vertex: the weighted mean of its bones' matrices, else the node's.
static std::vector<Mat4> pose_of(const aiMesh& mesh, const Mat4& transform,
                                 const std::map<std::string, Mat4>& by_name) {
    std::vector<Mat4> pose(mesh.mNumVertices, Mat4::Zero());
    std::vector<double> weights(mesh.mNumVertices, 0);
    for (unsigned b = 0; b < mesh.mNumBones; ++b) {
        const aiBone* bone = mesh.mBones[b];
        const auto found = bone ? by_name.find(bone->mName.C_Str()) : by_name.end();
        if (found == by_name.end()) continue;
        const Mat4 matrix = found->second * matrix_of(bone->mOffsetMatrix);
        if (!matrix.allFinite()) continue;
        for (unsigned w = 0; w < bone->mNumWeights; ++w) {
            const aiVertexWeight& weight = bone->mWeights[w];
            if (weight.mVertexId >= mesh.mNumVertices || !(weight.mWeight > 0 && weight.mWeight < 1e6f)) continue;
            pose[weight.mVertexId] += double(weight.mWeight) * matrix;
            weights[weight.mVertexId] += double(weight.mWeight);
        }
    }
    for (size_t i = 0; i < pose.size(); ++i) pose[i] = weights[i] > 1e-6 ? Mat4(pose[i] / weights[i]) : transform;
    return pose;
}

static void move_vertex(Corners& corners, size_t i, const Mat4& matrix, const Mat3& cofactor) {
    corners.positions[i] = (matrix * corners.positions[i].homogeneous()).head<3>();
    if (corners.normals.empty()) return;
    const Vec3 normal = (cofactor * corners.normals[i].cast<double>()).normalized();
    corners.normals[i] = normal.cast<float>();
}

// Returns the matrix for normals, the inverse transpose up to a factor. The cofactor matrix needs no division, but a
// mirror reverses its sign, which is undone here.
static Mat3 cofactor_of(const Mat4& matrix) {
    const Mat3 m = matrix.topLeftCorner<3, 3>();
    Mat3 cofactor;
    cofactor.col(0) = m.col(1).cross(m.col(2));
    cofactor.col(1) = m.col(2).cross(m.col(0));
    cofactor.col(2) = m.col(0).cross(m.col(1));
    return m.determinant() < 0 ? Mat3(-cofactor) : cofactor;
}

static void move_corners(Corners& corners, const aiMesh& mesh, const Mat4& transform,
                         const std::map<std::string, Mat4>& by_name) {
    bool is_mirrored;
    if (mesh.mNumBones > 0 && mesh.mBones && !corners.positions.empty()) {
        const std::vector<Mat4> pose = pose_of(mesh, transform, by_name);
        for (size_t i = 0; i < corners.positions.size(); ++i) move_vertex(corners, i, pose[i], cofactor_of(pose[i]));
        is_mirrored = pose.front().topLeftCorner<3, 3>().determinant() < 0;
    } else {
        const Mat3 cofactor = cofactor_of(transform);
        for (size_t i = 0; i < corners.positions.size(); ++i) move_vertex(corners, i, transform, cofactor);
        is_mirrored = transform.topLeftCorner<3, 3>().determinant() < 0;
    }
    // A mirror turns the triangles inside out.
    if (is_mirrored)
        for (Triangle& triangle : corners.triangles) std::swap(triangle[1], triangle[2]);
}

Surface take_scene(const aiScene& scene, const MeshFile& file) {
    Surface surface;
    const Mat4 frame = take_frame(scene, file, surface);
    const std::vector<SceneNode> nodes = list_nodes(scene);
    const std::vector<char> coarse = find_coarse_copies(nodes);
    std::map<std::string, Mat4> by_name;
    for (const SceneNode& node : nodes) by_name.emplace(node.node->mName.C_Str(), frame * node.transform);

    size_t dropped_lines = 0, dropped_copies = 0;
    double rounding = 0;
    std::map<std::string, Part> looks;  // by material index
    std::set<int> cut_out;              // textures whose alpha counts
    for (size_t n = 0; n < nodes.size(); ++n)
        for (unsigned m = 0; m < nodes[n].node->mNumMeshes; ++m) {
            const unsigned index = nodes[n].node->mMeshes[m];
            if (index >= scene.mNumMeshes || !scene.mMeshes[index]) continue;
            if (coarse[n]) {
                ++dropped_copies;
                continue;
            }
            const aiMesh& mesh = *scene.mMeshes[index];
            const std::string key = std::to_string(mesh.mMaterialIndex);
            if (!looks.count(key) && mesh.mMaterialIndex < scene.mNumMaterials) {
                const aiMaterial& material = *scene.mMaterials[mesh.mMaterialIndex];
                take_material(scene, material, file, mesh.HasTextureCoords(0), surface, looks[key]);
                if (counts_alpha(material, file)) cut_out.insert(looks[key].texture);
            }
            Part part = looks[key];
            part.name = name_part(nodes, int(n), mesh, file);
            const bool with_colors = wants_colors(mesh, file, part);
            const bool is_tinted = file.format == FileFormat::GLTF || file.format == FileFormat::GLB;
            if (with_colors && (!is_tinted || part.color == Part().color)) part.color = {1, 1, 1, 1};
            Corners corners = take_corners(mesh, file, with_colors, dropped_lines, surface.dropped_triangles);
            const double scale =
                frond::cbrt(std::abs((frame * nodes[n].transform).topLeftCorner<3, 3>().determinant()));
            rounding = std::max(rounding, scale * rounding_of(corners));
            if (mesh.mNumBones == 0) weld_corners(corners);
            move_corners(corners, mesh, frame * nodes[n].transform, by_name);
            if (mesh.mNumBones > 0) weld_corners(corners);
            append_part(surface, corners, part);
            if (surface.parts.size() > MOST_PARTS)
                fail(FROND_RESULT_BAD_GEOMETRY, "the file has more than %zu parts", MOST_PARTS);
        }
    for (const int texture : cut_out)
        if (texture >= 0) find_opacity(surface.textures[size_t(texture)]);
    if (dropped_copies > 0) warn("%zu coarser copies (LOD1 and up) are left out", dropped_copies);
    if (dropped_lines > 0) warn("%zu lines and points are left out", dropped_lines);
    if (surface.triangles.empty()) fail(FROND_RESULT_FILE_FORMAT, "there are no triangles in the file");
    check_precision(surface, rounding);
    return surface;
}

}  // namespace frond
