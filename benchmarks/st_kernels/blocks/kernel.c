__attribute__((noinline)) static void loop(PidLoop *self)
{
	self->cycles = self->cycles + 1;

	if (self->ramp < self->setpoint) {
		self->ramp = self->ramp + self->rate * self->dt;
		if (self->ramp > self->setpoint) {
			self->ramp = self->setpoint;
		}
	} else if (self->ramp > self->setpoint) {
		self->ramp = self->ramp - self->rate * self->dt;
		if (self->ramp < self->setpoint) {
			self->ramp = self->setpoint;
		}
	}

	self->error = self->ramp - self->actual;
	self->integral = self->integral + self->error * self->ki * self->dt;
	if (self->integral > self->integral_max) {
		self->integral = self->integral_max;
	} else if (self->integral < -self->integral_max) {
		self->integral = -self->integral_max;
	}
	self->derivative = (self->error - self->last) * self->kd / self->dt;
	self->last = self->error;
	self->out = self->kp * self->error + self->integral + self->derivative;

	self->limited = 1;
	if (self->out > self->out_max) {
		self->out = self->out_max;
	} else if (self->out < self->out_min) {
		self->out = self->out_min;
	} else {
		self->limited = 0;
	}

	self->actual = self->actual + (self->out - self->actual) * self->dt;
}

void cyclic(void)
{
	v.sum = 0.0f;
	for (v.number = 0; v.number <= 9; v.number++) {
		v.loops[v.number].setpoint = 10.0 * (float)v.number;
		loop(&v.loops[v.number]);
		v.sum = v.sum + v.loops[v.number].actual;
	}
}
