# shellcheck shell=bash
# ./hydro env: which environment is used, versions, folders and sizes.

print_environment() {
    local text versions command folder size
    case $way in
        root) text="private Debian root ($suite), entered by $entry; not the active Python: $python_reason" ;;
        active) text="active Python $python_executable, with a virtual environment on top" ;;
        inside) text="already inside" ;;
    esac
    command_inside python -
    # In place of the subshell, which would not end with this script.
    versions=$(
        exec "${ends_with_parent[@]}" "${command[@]}" <<'END'
import importlib.metadata as metadata, platform
import hydroelastic  # with it MPI leaves no folder
from petsc4py import PETSc
print(f"python       {platform.python_version()}")
for name in ("fenics-dolfinx", "petsc4py", "slepc4py", "gmsh", "vtk", "hydroelastic"):
    print(f"{name:<12} {metadata.version(name).strip()}")
print(f"scalars      {PETSc.ScalarType.__name__}")
END
    )
    text="way          $text"$'\n'$versions$'\n'"checkout     $checkout"$'\n'"cache        $cache"
    for folder in "$root" "$venv" "$forms" "$overlay"; do
        if [[ -d $folder ]]; then
            size=$(du -sh -- "$folder" 2>/dev/null | cut -f 1) || true
            text+=$(printf '\n%8s     %s' "$size" "$folder")
        fi
    done
    print "$text"
}
