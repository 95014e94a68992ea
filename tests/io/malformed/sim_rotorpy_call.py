import numpy as np
quad_params = {
    'mass': 0.03,
    'Ixx': load('inertia.txt'),
}
