#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# Builds, from the sources of this release of Debian, the libraries that a wheel holds, without what is not used: of
# OpenCASCADE shapes, meshes and STEP, of HDF5 and MED the serial C library, of Netgen nglib without window and Python,
# of Expat the library.
#   resources/packaging/wheel_libraries.sh FOLDER
# Nothing is done for what FOLDER has already.
set -eu
mkdir -p "$1/sources"
folder=$(realpath "$1")
cd "$folder/sources"

# Lists of sources of our own: the system need not have any, and stays as it is.
lists="-o Dir::Etc::SourceList=$folder/sources/list -o Dir::Etc::SourceParts=/dev/null
    -o Dir::State::Lists=$folder/sources/lists -o Dir::Cache=$folder/sources/cache -o APT::Sandbox::User=root"
source_of() { # package
    [ -d "$1" ] && return
    if [ ! -e list ]; then
        mirror=$(cat /etc/apt/sources.list /etc/apt/sources.list.d/* 2>/dev/null |
            sed -n -E 's/^(URIs:|deb( \[[^]]*\])?) +([^ ]+).*/\3/p' | grep -E '/debian/?$' | head -1)
        mkdir -p lists/partial cache/archives/partial
        . /etc/os-release
        echo "deb-src ${mirror:-http://deb.debian.org/debian} $VERSION_CODENAME main" >list.new
        # shellcheck disable=SC2086
        apt-get -o Dir::Etc::SourceList="$PWD/list.new" ${lists#*list} -qq update
        mv list.new list
    fi
    # shellcheck disable=SC2086
    apt-get $lists -qq source --download-only "$1"
    dpkg-source --no-check -x "$1"_*.dsc "$1.new" >/dev/null
    mkdir -p "$folder/licenses"
    cp "$1.new/debian/copyright" "$folder/licenses/$1"
    mv "$1.new" "$1"
}
# Configures a package by CMake and builds a target of it.
make_of() { # package's folder, target, CMake's arguments...
    package=${1%%/*}
    source=$1
    target=$2
    shift 2
    echo "building $package" >&2
    mkdir -p "build-$package"
    # Some look for what their checks write where CMake was started.
    (cd "build-$package" && cmake "../$source" -G Ninja -Wno-dev -DCMAKE_BUILD_TYPE=Release \
        -DCMAKE_POSITION_INDEPENDENT_CODE=ON -DCMAKE_INSTALL_PREFIX="$folder" -DCMAKE_PREFIX_PATH="$folder" \
        "$@") >"$package.log" 2>&1 &&
        cmake --build "build-$package" --target "$target" >>"$package.log" 2>&1 || {
        tail -20 "$package.log" >&2
        echo "wheel_libraries.sh: $package cannot be built; see $PWD/$package.log" >&2
        exit 1
    }
}

if [ ! -e "$folder/lib/libhdf5.a" ]; then
    source_of hdf5
    make_of hdf5 install -DBUILD_SHARED_LIBS=OFF -DBUILD_TESTING=OFF -DHDF5_BUILD_TOOLS=OFF \
        -DHDF5_BUILD_EXAMPLES=OFF -DHDF5_BUILD_HL_LIB=OFF -DHDF5_BUILD_CPP_LIB=OFF -DHDF5_BUILD_FORTRAN=OFF \
        -DHDF5_ENABLE_Z_LIB_SUPPORT=ON -DHDF5_ENABLE_SZIP_SUPPORT=OFF
fi
if [ ! -e "$folder/lib/libmedC.a" ]; then
    source_of med-fichier
    # Its tools cannot be linked to static libraries, so it cannot be installed as a whole.
    make_of med-fichier src/libmedC.a -DMEDFILE_BUILD_TESTS=OFF -DMEDFILE_BUILD_SHARED_LIBS=OFF \
        -DMEDFILE_BUILD_STATIC_LIBS=ON -DMEDFILE_INSTALL_DOC=OFF -DMED_MEDINT_TYPE=int -DHDF5_ROOT_DIR="$folder"
    find med-fichier/include build-med-fichier/include -maxdepth 1 -name '*.h*' -exec cp {} "$folder/include/" \;
    cp build-med-fichier/src/libmedC.a "$folder/lib/"
fi
if [ ! -e "$folder/lib/libexpat.a" ]; then
    source_of expat
    # Debian's corrections ask for the value that configure gives, and CMake does not.
    sed -i 's/^#cmakedefine XML_DTD$/#cmakedefine XML_DTD 1/' expat/expat/expat_config.h.cmake
    make_of expat/expat install -DEXPAT_SHARED_LIBS=OFF -DEXPAT_BUILD_TOOLS=OFF -DEXPAT_BUILD_EXAMPLES=OFF \
        -DEXPAT_BUILD_TESTS=OFF -DEXPAT_BUILD_DOCS=OFF -DEXPAT_BUILD_PKGCONFIG=OFF
fi
if [ ! -e "$folder/lib/libnglib.so" ]; then
    source_of netgen
    # Versions of parts that are not built.
    sed -i '/^set_target_properties(.* PROPERTIES VERSION/d' netgen/CMakeLists.txt
    make_of netgen nglib -DUSE_SUPERBUILD=OFF -DUSE_GUI=OFF -DUSE_PYTHON=OFF -DUSE_OCC=OFF -DUSE_NATIVE_ARCH=OFF \
        -DCMAKE_SKIP_BUILD_RPATH=ON
    mkdir -p "$folder/include/netgen"
    cp netgen/nglib/nglib.h "$folder/include/netgen/"
    find build-netgen -name 'lib*.so' -exec cp {} "$folder/lib/" \;
fi
if [ ! -e "$folder/lib/libTKSTEP.a" ]; then
    source_of opencascade
    # One copy of its types and their tables for each library, also where another is in the process.
    make_of opencascade install -DBUILD_LIBRARY_TYPE=Static -DINSTALL_DIR="$folder" -DINSTALL_DIR_LIB=lib \
        -DINSTALL_DIR_INCLUDE=include/opencascade \
        -DCMAKE_CXX_FLAGS="-fno-gnu-unique -ffunction-sections -fdata-sections -w" \
        -DBUILD_MODULE_FoundationClasses=OFF -DBUILD_MODULE_ModelingData=OFF -DBUILD_MODULE_ModelingAlgorithms=OFF \
        -DBUILD_MODULE_Visualization=OFF -DBUILD_MODULE_ApplicationFramework=OFF -DBUILD_MODULE_DataExchange=OFF \
        -DBUILD_MODULE_Draw=OFF -DBUILD_DOC_Overview=OFF "-DBUILD_ADDITIONAL_TOOLKITS=TKSTEP;TKMesh" -DUSE_TBB=OFF \
        -DUSE_FREETYPE=OFF -DUSE_TK=OFF -DUSE_OPENGL=OFF
fi
