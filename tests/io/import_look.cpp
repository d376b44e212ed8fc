// A plant's appearance is imported from all places where files keep it: materials, images beside the model, emission.
#include <gtest/gtest.h>

#include "io/import.hpp"
#include "io/import_files.hpp"

using namespace frond;

static const Part& part_of(const Surface& surface, const std::string& name) {
    for (const Part& part : surface.parts)
        if (part.name == name) return part;
    ADD_FAILURE() << "there is no part " << name;
    return surface.parts.front();
}

static std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

static void make_folder(const files::Folder& folder, const std::string& name) {
    std::filesystem::create_directories(folder.path + "/" + name);
}

TEST(ImportLook, TakesTheMaterialLibraryOfTheModelsNameWhereNoneIsNamed) {
    files::Folder folder;
    folder.write("plant.mtl", "newmtl bark\nKd 0.5 0.25 0\nnewmtl green\nKd 0 0.5 0\n");
    const Surface surface = import_surface(folder.write("plant.obj", files::obj()), {});
    EXPECT_NEAR(part_of(surface, "stem").color[0], 0.2140f, 1e-3f);
    EXPECT_NEAR(part_of(surface, "leaf").color[1], 0.2140f, 1e-3f);
}

TEST(ImportLook, TakesAPictureCalledLikeTheMaterialOrTheModel) {
    for (const char* picture : {"green.png", "Green_diffuse.PNG", "plant.png", "plant-albedo.png"}) {
        files::Folder folder;
        folder.write(picture, files::png());
        folder.write("green_normal.png", "not this one");
        const Surface surface = import_surface(folder.write("plant.obj", files::obj()), {});
        EXPECT_EQ(part_of(surface, "leaf").texture, 0) << picture;
        EXPECT_EQ(part_of(surface, "leaf").color[0], 1.0f);
        EXPECT_EQ(part_of(surface, "stem").texture, -1) << "without texture coordinates";
        ASSERT_EQ(surface.textures.size(), 1u);
        EXPECT_EQ(surface.textures[0].bytes.size(), files::png().size());
    }
}

TEST(ImportLook, APlyFileTakesThePictureOfItsName) {
    const std::string text =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
        "property float u\nproperty float v\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
        "0 0 0 0 0\n0.1 0 0 1 0\n0 0.5 0 0 1\n3 0 1 2\n";
    files::Folder folder;
    folder.write("Fern.jpg", files::png());
    EXPECT_EQ(import_surface(folder.write("fern.ply", text), {}).parts[0].texture, 0);
    EXPECT_EQ(import_surface(folder.write("ivy.ply", text), {}).parts[0].texture, -1);
}

TEST(ImportLook, TakesNoPictureByItsNameWhereAColorWasChosen) {
    files::Folder folder;
    folder.write("green.png", files::png());
    folder.write("plant.mtl", "newmtl bark\nKd 0.5 0.5 0\nnewmtl green\nKd 0 0.5 0\n");
    const Surface surface = import_surface(folder.write("plant.obj", files::obj(false, "plant.mtl")), {});
    EXPECT_TRUE(surface.textures.empty());
}

TEST(ImportLook, FindsAPictureInTheFolderForPicturesBesideTheModels) {
    files::Folder folder;
    make_folder(folder, "models");
    make_folder(folder, "textures");
    folder.write("models/plant.mtl", "newmtl green\nmap_Kd work/Leaf.tga\n");
    folder.write("textures/leaf.png", files::png());
    const Surface surface = import_surface(folder.write("models/plant.obj", files::obj(false, "plant.mtl")), {});
    EXPECT_EQ(part_of(surface, "leaf").texture, 0) << "in another format, too";
}

TEST(ImportLook, LeavesTheColorOpenWhereATextureIsMissing) {
    files::Folder folder;
    folder.write("plant.mtl", "newmtl bark\nKd 0.5 0.5 0\nnewmtl green\nKd 1 1 1\nmap_Kd gone.png\n");
    const Surface surface = import_surface(folder.write("plant.obj", files::obj(false, "plant.mtl")), {});
    EXPECT_EQ(part_of(surface, "leaf").color, Part().color);
    EXPECT_NE(part_of(surface, "stem").color, Part().color);
}

TEST(ImportLook, WhatOnlyGlowsLooksAsItGlows) {
    files::Folder folder;
    std::string json = replaced(files::gltf_json(), "\"baseColorFactor\":[0.25,0.5,0.125,1]}",
                                "\"baseColorFactor\":[0,0,0,1]},\"emissiveFactor\":[0.5,0.25,0]");
    json = replaced(json, "\"baseColorFactor\":[1,0.5,1,1],\"baseColorTexture\":{\"index\":0}}",
                    "\"baseColorFactor\":[0,0,0,1]},\"emissiveFactor\":[1,1,1],\"emissiveTexture\":{\"index\":0}");
    const Surface surface = import_surface(folder.write("plant.glb", files::glb_of(json, files::glb_binary())), {});
    EXPECT_NEAR(part_of(surface, "stem").color[0], 0.5f, 1e-6f);
    EXPECT_NEAR(part_of(surface, "stem").color[1], 0.25f, 1e-6f);
    EXPECT_EQ(part_of(surface, "leaf").texture, 0);
    EXPECT_EQ(part_of(surface, "leaf").color[1], 1.0f);
}

TEST(ImportLook, ColorsThatBlenderWroteAreLinear) {
    files::Folder folder;
    folder.write("plant.mtl", "newmtl bark\nKd 0.5 0.5 0\nnewmtl green\nKd 0 0.5 0\n");
    const Surface by_blender =
        import_surface(folder.write("plant.obj", "# Blender 3.3.1\n" + files::obj(false, "plant.mtl")), {});
    EXPECT_NEAR(part_of(by_blender, "stem").color[0], 0.5f, 1e-6f);
    const std::string dae = replaced(files::dae(false), "<asset>",
                                     "<asset><contributor><authoring_tool>Blender 2.79</authoring_tool></contributor>");
    const Surface collada = import_surface(folder.write("plant.dae", dae), {});
    EXPECT_NEAR(part_of(collada, "stem").color[0], 0.5f, 1e-6f);
}

static double opacity_of_leaf(const Surface& surface) {
    OpacitySum sum;
    const Part& leaf = part_of(surface, "leaf");
    for (int t = leaf.first_triangle; t < leaf.first_triangle + leaf.triangle_count; t++)
        sum.add(surface, leaf, surface.triangles[size_t(t)]);
    return sum.mean();
}

TEST(ImportLook, FindsOutWhatATextureCutsOut) {
    for (const int column : {8, 6, 4, 1}) {
        files::Folder folder;
        folder.write("plant.mtl", "newmtl green\nmap_Kd leaf.tga\n");
        folder.write("leaf.tga", files::tga_cut_from(column));
        const Surface surface = import_surface(folder.write("plant.obj", files::obj(false, "plant.mtl")), {});
        EXPECT_EQ(surface.textures[0].opacity.empty(), column == 8);
        EXPECT_NEAR(opacity_of_leaf(surface), column / 8.0, 0.05) << column;
    }
}

TEST(ImportLook, ColoursOfAPaletteMayCutOut) {
    files::Folder folder;
    folder.write("plant.mtl", "newmtl green\nmap_Kd leaf.png\n");
    folder.write("leaf.png", files::palette_png_cut_from(6));
    const Surface surface = import_surface(folder.write("plant.obj", files::obj(false, "plant.mtl")), {});
    EXPECT_NEAR(opacity_of_leaf(surface), 0.75, 0.05);
}

TEST(ImportLook, GlossKeptInAlphaCutsOutNothing) {
    files::Folder folder;
    folder.write("plant.mtl", "newmtl green\nmap_Kd leaf.tga\n");
    folder.write("leaf.tga", files::tga({60, 80, 100, 120, 140, 160, 180, 200}));
    const Surface surface = import_surface(folder.write("plant.obj", files::obj(false, "plant.mtl")), {});
    EXPECT_TRUE(surface.textures[0].opacity.empty());
}

TEST(ImportLook, InGltfAlphaCutsOutWhereTheMaterialSaysSo) {
    for (const std::string mode :
         {"", "\"alphaMode\":\"OPAQUE\",", "\"alphaMode\":\"MASK\",", "\"alphaMode\":\"BLEND\","}) {
        files::Folder folder;
        folder.write("leaf.tga", files::tga_cut_from(4));
        folder.write("plant.bin", files::glb_binary());
        const std::string json =
            replaced(replaced(files::gltf_json("plant.bin"), "{\"name\":\"green\",", "{\"name\":\"green\"," + mode),
                     R"({"bufferView":5,"mimeType":"image/png","name":"leaf_image"})", R"({"uri":"leaf.tga"})");
        const Surface surface = import_surface(folder.write("plant.gltf", json), {});
        const bool cuts = mode.find("MASK") != std::string::npos || mode.find("BLEND") != std::string::npos;
        EXPECT_NEAR(opacity_of_leaf(surface), cuts ? 0.5 : 1, 0.05) << mode;
    }
}
