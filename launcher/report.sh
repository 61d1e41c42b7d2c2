# shellcheck shell=bash
# ./hydro env: which environment is used, versions, folders and sizes.

print_environment() {
    local folder size
    case $way in
        root)
            printf 'way          private Debian root (%s), entered by %s; not the active Python: %s\n' \
                "$suite" "$entry" "$python_reason"
            ;;
        active) printf 'way          active Python %s, with a virtual environment on top\n' "$python_executable" ;;
        inside) printf 'way          already inside\n' ;;
    esac
    inside python - <<'END'
import importlib.metadata as metadata, platform
from petsc4py import PETSc
print(f"python       {platform.python_version()}")
for name in ("fenics-dolfinx", "petsc4py", "slepc4py", "gmsh", "vtk", "hydroelastic"):
    print(f"{name:<12} {metadata.version(name).strip()}")
print(f"scalars      {PETSc.ScalarType.__name__}")
END
    printf 'checkout     %s\ncache        %s\n' "$checkout" "$cache"
    for folder in "$root" "$venv" "$forms" "$overlay"; do
        if [[ -d $folder ]]; then
            size=$(du -sh -- "$folder" 2>/dev/null | cut -f 1) || true
            printf '%8s     %s\n' "$size" "$folder"
        fi
    done
}
