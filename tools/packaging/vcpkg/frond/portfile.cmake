# An overlay port that lies in the tree that it builds: vcpkg install frond --overlay-ports=tools/packaging/vcpkg
# In a registry, vcpkg_from_git takes the place of the next line.
get_filename_component(SOURCE_PATH "${CMAKE_CURRENT_LIST_DIR}/../../../.." ABSOLUTE)

string(COMPARE EQUAL "${VCPKG_LIBRARY_LINKAGE}" "dynamic" FROND_SHARED)
string(COMPARE EQUAL "${VCPKG_LIBRARY_LINKAGE}" "static" FROND_STATIC)
vcpkg_check_features(OUT_FEATURE_OPTIONS FEATURE_OPTIONS
    FEATURES
        importer            FROND_IMPORTER
        double-precision    FROND_FLOAT64
)
vcpkg_find_acquire_program(PKGCONFIG)

vcpkg_cmake_configure(
    SOURCE_PATH "${SOURCE_PATH}"
    OPTIONS
        -DFROND_TESTS=OFF
        -DFROND_TOOLS=OFF
        -DFROND_BUILD_PATHS=OFF
        -DFROND_IMPORTER_INSTALL_PATH=
        -DCMAKE_INSTALL_LIBEXECDIR=tools
        -DFROND_SHARED=${FROND_SHARED}
        -DFROND_STATIC=${FROND_STATIC}
        "-DPKG_CONFIG_EXECUTABLE=${PKGCONFIG}"
        ${FEATURE_OPTIONS}
)
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(CONFIG_PATH lib/cmake/Frond)
vcpkg_fixup_pkgconfig()

# The library looks for tools/frond/frond-import from its own folder.
if("importer" IN_LIST FEATURES)
    vcpkg_copy_tool_dependencies("${CURRENT_PACKAGES_DIR}/tools/frond")
endif()
file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/debug/include" "${CURRENT_PACKAGES_DIR}/debug/share"
                    "${CURRENT_PACKAGES_DIR}/debug/tools")
file(INSTALL "${CMAKE_CURRENT_LIST_DIR}/usage" DESTINATION "${CURRENT_PACKAGES_DIR}/share/${PORT}")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENCE")
