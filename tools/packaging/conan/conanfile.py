"""Frond as a Conan package: conan create tools/packaging/conan

The library in one precision, shared or static, with the program that reads mesh files unless importer=False.
"""
import os
import re

from conan import ConanFile
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain, cmake_layout
from conan.tools.files import copy, load, rmdir
from conan.tools.gnu import PkgConfigDeps

PARTS = ("CMakeLists.txt", "LICENCE", "plugin/CMakeLists.txt", "plugin/*.cmake", "plugin/*.in", "plugin/include/*", "plugin/src/*",
         "tools/packaging/archive.cmake")


class Frond(ConanFile):
    name = "frond"
    description = "Plants that bend, for worlds simulated by the Bullet physics engine"
    license = "Zlib"
    topics = ("physics", "plants", "bullet", "soft-body")
    package_type = "library"
    settings = "os", "arch", "compiler", "build_type"
    options = {"shared": [True, False], "fPIC": [True, False], "double_precision": [True, False], "importer": [True, False]}
    default_options = {"shared": True, "fPIC": True, "double_precision": False, "importer": True}
    implements = ["auto_shared_fpic"]

    @property
    def _tree(self):
        return os.path.join(self.recipe_folder, "..", "..", "..")

    def set_version(self):
        header = load(self, os.path.join(self._tree, "plugin", "include", "frond", "frond_types.h"))
        self.version = ".".join(re.findall(r"#define FROND_VERSION_(?:MAJOR|MINOR|PATCH) (\d+)", header))

    def export_sources(self):
        for part in PARTS:
            copy(self, part, self._tree, self.export_sources_folder)

    def layout(self):
        cmake_layout(self)

    def requirements(self):
        self.requires("bullet3/[>=3.24 <4]", transitive_headers=True, options={"double_precision": self.options.double_precision})
        self.requires("eigen/[>=3.4 <4]", visible=False)
        if self.options.importer:
            for name in ("assimp/[>=5.0 <6]", "nlohmann_json/[>=3.9 <4]", "meshoptimizer/[>=0.18 <1]", "urdfdom/[>=3 <5]",
                         "tinyxml2/[>=9 <12]", "console_bridge/[>=1.0 <2]", "stb/[*]"):
                self.requires(name, visible=False)

    def generate(self):
        CMakeDeps(self).generate()
        PkgConfigDeps(self).generate()
        toolchain = CMakeToolchain(self)
        toolchain.cache_variables.update({
            "FROND_TESTS": False, "FROND_TOOLS": False, "FROND_BUILD_PATHS": False, "FROND_IMPORTER_INSTALL_PATH": "",
            "FROND_SHARED": bool(self.options.shared), "FROND_STATIC": not self.options.shared,
            "FROND_FLOAT64": bool(self.options.double_precision), "FROND_IMPORTER": bool(self.options.importer)})
        toolchain.generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        CMake(self).install()
        copy(self, "LICENCE", self.source_folder, os.path.join(self.package_folder, "licenses"))
        # Conan writes its own, for its own packages of what Frond needs.
        for folder in ("cmake", "pkgconfig"):
            rmdir(self, os.path.join(self.package_folder, "lib", folder))

    def package_info(self):
        double = bool(self.options.double_precision)
        self.cpp_info.libs = ["frond-float64" if double else "frond"]
        self.cpp_info.set_property("cmake_file_name", "Frond")
        self.cpp_info.set_property("cmake_target_name", "Frond::frond_float64" if double else "Frond::frond")
        self.cpp_info.set_property("pkg_config_name", "frond-float64" if double else "frond")
        if not self.options.shared and self.settings.os == "Linux":
            self.cpp_info.system_libs = ["m", "dl", "pthread"]
        if self.options.importer:
            self.runenv_info.define_path("FROND_IMPORTER", os.path.join(
                self.package_folder, "libexec", "frond", "frond-import" + (".exe" if self.settings.os == "Windows" else "")))
