/// Extensions that a file may require. (`KHR_materials_specular` and its like also work undeclared.)
pub(super) const UNDERSTOOD: [&str; 4] = [
    "KHR_lights_punctual",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_specular",
];
