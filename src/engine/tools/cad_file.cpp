// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/cad_file.h"

#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <STEPControl_Reader.hxx>
#include <Standard_Failure.hxx>

#include <sstream>

#include <system_error>

#include "error.h"

namespace femscalpel {

TopoDS_Shape read_cad_file(const std::filesystem::path& path) {
    std::string suffix = path.extension().string();
    for (char& c : suffix) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    const std::string name = path.string();
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error)) throw ReadError("'" + name + "' is not a file", "source");
    TopoDS_Shape shape;
    try {
        if (suffix == ".step" || suffix == ".stp") {
            STEPControl_Reader reader;
            if (reader.ReadFile(name.c_str()) != IFSelect_RetDone)
                throw ReadError("'" + name + "' is not a STEP file that OpenCASCADE can read", "source");
            reader.TransferRoots();
            shape = reader.OneShape();
        } else if (suffix == ".brep" || suffix == ".brp") {
            BRep_Builder builder;
            if (!BRepTools::Read(shape, name.c_str(), builder))
                throw ReadError("'" + name + "' is not a BREP file that OpenCASCADE can read", "source");
        } else {
            throw ReadError("'" + name + "': the suffix is '" + suffix +
                                "'; shapes are read from .step, .stp, .brep and .brp files",
                            "source");
        }
    } catch (const Standard_Failure& e) {
        throw ReadError("'" + name + "': OpenCASCADE says: " + e.GetMessageString(), "source");
    }
    if (shape.IsNull()) throw ReadError("'" + name + "' holds no shape", "source");
    return shape;
}

TopoDS_Shape shape_from_brep(const std::string& text, const std::string& what) {
    TopoDS_Shape shape;
    try {
        std::istringstream stream(text);
        BRep_Builder builder;
        BRepTools::Read(shape, stream, builder);
    } catch (const Standard_Failure& e) {
        throw ToolError(what + ": OpenCASCADE says: " + e.GetMessageString(), "source");
    }
    if (shape.IsNull()) throw ToolError(what + ": the text is not a BREP shape", "source");
    return shape;
}

}  // namespace femscalpel
